# SPDX-License-Identifier: GPL-3.0-or-later
# Manual pages. packaging/man has them as they were made from --help of the programs, so that nothing that was built has
# to run here; tst_manuals fails when they are old, and writes them with PITCHBOARD_WRITE_DOCS=1. Only version and date
# are filled in.
set(PITCHBOARD_PAGES ${CMAKE_CURRENT_LIST_DIR}/man)

# pitchboard_release_date(<CHANGELOG.md>): PITCHBOARD_RELEASE_DATE is the date in the heading of this version.
macro(pitchboard_release_date changes)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changes})
  file(STRINGS ${changes} heading LIMIT_COUNT 1 REGEX "^## ${PROJECT_VERSION} \\(....-..-..\\)$")
  if(NOT heading)
    message(FATAL_ERROR "CHANGELOG.md has no line \"## ${PROJECT_VERSION} (YEAR-MONTH-DAY)\"; add it")
  endif()
  string(REGEX MATCH "....-..-.." PITCHBOARD_RELEASE_DATE "${heading}")
endmacro()

# pitchboard_manual_pages(<pattern>...)
function(pitchboard_manual_pages)
  list(TRANSFORM ARGN PREPEND ${PITCHBOARD_PAGES}/)
  file(GLOB pages CONFIGURE_DEPENDS ${ARGN})
  foreach(page IN LISTS pages)
    cmake_path(GET page FILENAME name)
    configure_file(${page} ${CMAKE_CURRENT_BINARY_DIR}/man1/${name} @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/man1/${name} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endforeach()
endfunction()
