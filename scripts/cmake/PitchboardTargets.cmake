# SPDX-License-Identifier: GPL-3.0-or-later
# One way to make a library, a program and a test, so that warnings, sanitizers, the compiler
# cache and floating-point rules are the same everywhere.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# pitchboard_needs(<package> <version> [OPTION of find_package...]): a package of this version or a later one. Asked for
# a version, its own file might refuse a later one: pagmo 2.19 is not "2.18" to it, and a new major version rarely is.
# docs/building.md lists these versions (scripts/check_docs.py compares them).
macro(pitchboard_needs package version)
  find_package(${package} REQUIRED ${ARGN})
  if(${package}_VERSION VERSION_LESS ${version})
    message(FATAL_ERROR "Pitchboard needs ${package} ${version} or later, and this system has ${${package}_VERSION}. "
                        "Install a later version (docs/building.md lists all of them).")
  endif()
endmacro()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # The sloppiness settings let precompiled headers hit the cache; the base directory lets two
  # checkouts share it.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} ${CCACHE_PROGRAM})
endif()

if(PITCHBOARD_SANITIZE)
  add_compile_options(-fsanitize=${PITCHBOARD_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PITCHBOARD_SANITIZE})
  if(PITCHBOARD_SANITIZE MATCHES undefined)
    # UBSan prints and goes on by default, and the test would pass.
    add_compile_options(-fno-sanitize-recover=all)
  endif()
endif()

# A simulation step must give the same bits in every build: no fused multiply-add, no -ffast-math.
add_compile_options(-ffp-contract=off)
# Lets gcc use precompiled headers that ccache may have restored.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)

# gcc 12 warns wrongly about "text" + std::to_string(n), with -Wrestrict (gcc bug 105329) and, when
# <string> is precompiled, with -Warray-bounds and -Wstringop-*, too. ASan does look there.
# clang's -Wshadow also means names of other files that are compiled together with this one; its -Wall also
# means functions that only share their name with a virtual one of Qt, as EventList::event(row).
function(pitchboard_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>
                         $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow;-Wno-overloaded-virtual>
                         $<$<BOOL:${PITCHBOARD_WERROR}>:-Werror>)
endfunction()

# Everything without Qt can go into a shared library (robotlink/capi), and is as quick as if it could not:
# no function of ours is ever replaced by another of its name. Programs have the same options, so that
# the precompiled header serves them, too. (What uses Qt has -fPIC from Qt.)
function(pitchboard_position_independent target)
  target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition)
endfunction()

# A name in one file of a module says nothing about names in another. Where several files are compiled together
# (CMAKE_UNITY_BUILD), gcc takes them for one: local names of one would be in the shadow of another's, what stands
# in an unnamed namespace would belong to a header, and where more is inlined, gcc 12 takes what an empty optional
# does not hold for read. What is built file by file (dev, no-pch) has these warnings, too.
function(pitchboard_several_files target)
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wshadow=local;-Wno-subobject-linkage;-Wno-maybe-uninitialized>)
  endif()
endfunction()

# For dialogs, reports and command lines (-O1) and tests (-O0): at -O3 they compile up to twice as long, for
# nothing. What they call is in the modules whose loops take time.
function(pitchboard_compile_quickly target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# A precompiled header serves only what is compiled with the same options; gcc 13 and later refuse it to another level of
# optimization. A header that modules of both levels use is therefore made twice: <target>, and <target>_light at -O1.
# pitchboard_precompiled(<target> HEADERS ... [LIBS ...]) makes them; pitchboard_use_precompiled(<target> <header> <light>)
# chooses one. They only save time: every file includes what it needs, as a build with
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON shows.
function(pitchboard_precompiled target)
  cmake_parse_arguments(ARG "POSITION_INDEPENDENT" "" "HEADERS;LIBS" ${ARGN})
  file(CONFIGURE OUTPUT precompiled.cpp CONTENT "")
  foreach(name IN ITEMS ${target} ${target}_light)
    add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
    set_target_properties(${name} PROPERTIES AUTOMOC OFF)
    target_link_libraries(${name} PRIVATE ${ARG_LIBS})
    target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
    pitchboard_warnings(${name})
    if(ARG_POSITION_INDEPENDENT)
      pitchboard_position_independent(${name})
    endif()
  endforeach()
  pitchboard_compile_quickly(${target}_light -O1)
  set_target_properties(${target} ${target}_light PROPERTIES EXCLUDE_FROM_ALL ON)  # built where they are used
endfunction()
function(pitchboard_use_precompiled target header light)
  if(light AND CMAKE_BUILD_TYPE STREQUAL Release)  # all other builds have one level
    string(APPEND header _light)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${header})
endfunction()

# pitchboard_module(<library> <module> [LIGHTLY_OPTIMIZED] SOURCES ... [PUBLIC libs] [PRIVATE libs])
# makes <library>::<module> from the current directory: include/ holds what other modules may include,
# src/ the rest. LIGHTLY_OPTIMIZED: nobody waits for a loop in it; compiled at -O1. A module can include
# a header of another one only when it links it here, and tests/end_to_end/tst_layers.cpp holds which modules may
# be linked. All modules of a library together are <library>::all. The presets that build everything at once
# (release, the sanitizers) compile several files of a module together (CMAKE_UNITY_BUILD): a third of the time.
function(pitchboard_module library module)
  cmake_parse_arguments(ARG "LIGHTLY_OPTIMIZED" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target ${library}_${module})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(${library}::${module} ALIAS ${target})
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include
                             PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pitchboard_warnings(${target})
  pitchboard_several_files(${target})
  if(ARG_LIGHTLY_OPTIMIZED)
    pitchboard_compile_quickly(${target} -O1)
  endif()
  # One precompiled header for everything without Qt, one with <QtWidgets> for the window.
  if(library STREQUAL ui)
    pitchboard_use_precompiled(${target} ui_precompiled ${ARG_LIGHTLY_OPTIMIZED})
  else()
    pitchboard_position_independent(${target})
    pitchboard_use_precompiled(${target} precompiled ${ARG_LIGHTLY_OPTIMIZED})
  endif()
endfunction()

# pitchboard_modules(<library> <folder>...): adds the folders of the modules, which have their names, and <library>::all.
function(pitchboard_modules library)
  add_library(${library}_all INTERFACE)
  add_library(${library}::all ALIAS ${library}_all)
  foreach(folder IN LISTS ARGN)
    add_subdirectory(${folder})
    get_filename_component(module ${folder} NAME)
    target_link_libraries(${library}_all INTERFACE ${library}::${module})
  endforeach()
endfunction()

# pitchboard_program(<name> SOURCES ... LIBS ...)
function(pitchboard_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  if(NOT ui::window IN_LIST ARG_LIBS)
    pitchboard_position_independent(${name})
    target_precompile_headers(${name} REUSE_FROM app_command_line)
  endif()
  target_compile_definitions(${name} PRIVATE PITCHBOARD_VERSION="${PROJECT_VERSION}")
  pitchboard_warnings(${name})
  pitchboard_several_files(${name})
  pitchboard_compile_quickly(${name} -O1)
  set_property(GLOBAL APPEND PROPERTY PITCHBOARD_PROGRAMS ${name})
endfunction()

find_program(LLD_PROGRAM ld.lld)  # a sixth of the time of ld

# What every program of tests has: QtTest, the paths of programs and data, no optimization.
function(pitchboard_test_options name)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE Qt6::Test)
  target_compile_options(${name} PRIVATE "SHELL:-include ${PROJECT_SOURCE_DIR}/tests/support/test_program.h")
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/moc)
  target_compile_definitions(${name} PRIVATE
    PITCHBOARD_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data"
    PITCHBOARD_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    PITCHBOARD_BIN="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  pitchboard_warnings(${name})
  # gcc takes what stands in an unnamed namespace of a file compiled together with others for a header's.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  if(Qt6_VERSION VERSION_GREATER_EQUAL 6.5)
    target_compile_options(${name} PRIVATE -Wno-conversion)  # its QTRY_VERIFY makes an int of milliseconds in our code
  endif()
  pitchboard_compile_quickly(${name} -O0)
  if(LLD_PROGRAM)
    target_link_options(${name} PRIVATE -fuse-ld=lld)
  endif()
endfunction()

# pitchboard_test(<name> SOURCES ... LIBS ... [INSIDE modules] [PART part] [LABELS ...] [TIMEOUT s] [GUI] [ALONE]): a
# test with one QtTest class in the first source, <name>.cpp, registered as tests/support/test_program.h says. It
# becomes part of the program tests_<folder>, and a test of its own for ctest. ALONE makes a program of its own, for
# tests that replace functions of the C library or that other checks build alone. GUI tests run offscreen. INSIDE
# names the modules (ui/plots) whose private headers it may include; tests of one PART are compiled together, and no
# others see these headers. Every test has its folder as a label; `threads` are those in which threads of ours work
# at the same time: they run under TSan too; `every_build` are those that continuous integration runs with and
# without sanitizers. build_<label>_tests builds the tests of a label.
function(pitchboard_test name)
  cmake_parse_arguments(ARG "GUI;ALONE" "PART;TIMEOUT" "SOURCES;LIBS;LABELS;INSIDE" ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  if(ARG_ALONE)
    set(program ${name})
    set(command ${name})
  else()
    set(program tests_${folder})
    set(command ${program} ${name})
  endif()
  if(NOT TARGET ${program})
    add_executable(${program})
    pitchboard_test_options(${program})
    if(NOT ARG_ALONE)
      target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/test_program.cpp)
    endif()
    if(PITCHBOARD_SANITIZE MATCHES thread)
      target_sources(${program} PRIVATE $<TARGET_OBJECTS:tests_own_memory>)
    endif()
  endif()
  set(compiled ${program})
  if(ARG_PART)
    set(compiled ${program}_${ARG_PART})
    if(NOT TARGET ${compiled})
      add_library(${compiled} OBJECT)
      pitchboard_test_options(${compiled})
      target_link_libraries(${program} PRIVATE ${compiled})
    endif()
    target_link_libraries(${program} PRIVATE ${ARG_LIBS})
  endif()
  # moc for the one file that has a test class. AUTOMOC would look at each test twice and compile an
  # empty file for it: a tenth of the time of a build.
  set(moc ${CMAKE_CURRENT_BINARY_DIR}/moc/${name}.moc)
  list(GET ARG_SOURCES 0 source)
  qt6_generate_moc(${source} ${moc} TARGET ${compiled})
  target_sources(${compiled} PRIVATE ${ARG_SOURCES} ${moc})
  target_link_libraries(${compiled} PRIVATE ${ARG_LIBS})
  foreach(module IN LISTS ARG_INSIDE)
    target_include_directories(${compiled} PRIVATE ${PROJECT_SOURCE_DIR}/${module}/src)
  endforeach()
  add_test(NAME ${name} COMMAND ${command})
  set(environment "LC_ALL=C.UTF-8")
  if(ARG_GUI)
    list(APPEND environment "QT_QPA_PLATFORM=offscreen")
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if(PITCHBOARD_SANITIZE)
    set(suppressions ${PROJECT_SOURCE_DIR}/tests/sanitizers)
    list(APPEND environment
         "ASAN_OPTIONS=suppressions=${suppressions}/asan.supp:detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1"
         "LSAN_OPTIONS=suppressions=${suppressions}/lsan.supp:print_suppressions=0"
         "UBSAN_OPTIONS=print_stacktrace=1" "QTEST_FUNCTION_TIMEOUT=1800000"  # TIMEOUT is the limit
         # The child of a process with threads: it soon becomes another program.
         "TSAN_OPTIONS=suppressions=${suppressions}/tsan.supp:second_deadlock_stack=1:die_after_fork=0")
    math(EXPR ARG_TIMEOUT "${ARG_TIMEOUT} * 4")
  endif()
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${environment}" LABELS "${folder};${ARG_LABELS}"
                       TIMEOUT ${ARG_TIMEOUT})
  if("slow" IN_LIST ARG_LABELS)
    set_tests_properties(${name} PROPERTIES COST 100)  # first, also where ctest has not measured them yet
  endif()
  foreach(label IN ITEMS ${folder} ${ARG_LABELS})
    if(NOT TARGET build_${label}_tests)
      add_custom_target(build_${label}_tests)
    endif()
    add_dependencies(build_${label}_tests ${program})
  endforeach()
endfunction()
