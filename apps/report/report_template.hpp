#pragma once
#include <string_view>

namespace luciole {

/// The page of `luciole compare` as one HTML file, UTF-8, that fetches nothing. It holds the text @LUCIOLE_REPORT@ once,
/// inside a script element of type application/json: put the data there, with each `<` as \u003c. What the data must
/// look like: docs/report.md.
/// \return empty if Luciole was built without Node.js or without the packages of apps/report
std::string_view reportTemplate();

}  // namespace luciole
