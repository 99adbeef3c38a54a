// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/variable_catalog.h>

#include "catalog_reading.h"

namespace pitchboard::link {
Result<VariableCatalog> VariableCatalog::fromHeader(std::string_view, std::string_view source) {
  return failure(ErrorCode::Unsupported, "not yet", std::string(source));
}
}  // namespace pitchboard::link
