#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "report_template.hpp"

using luciole::reportTemplate;

TEST_CASE("report template: it is the bundled page, byte for byte, or empty without one") {
    std::ifstream file(LUCIOLE_REPORT_TEMPLATE, std::ios::binary);
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    CHECK(page == reportTemplate());
    CHECK(page.empty() == std::string(LUCIOLE_REPORT_TEMPLATE).empty());
}

TEST_CASE("report template: data has one place, and nothing is fetched from anywhere") {
    const std::string_view page = reportTemplate();
    if (page.empty()) return;
    const std::string_view marker = "@LUCIOLE_REPORT@";
    const size_t place = page.find(marker);
    REQUIRE(place != std::string_view::npos);
    CHECK(page.find(marker, place + 1) == std::string_view::npos);
    CHECK(page.substr(0, place).ends_with("type=\"application/json\" id=\"report-data\">"));
    for (const std::string_view word : {" src=", "<link rel=\"stylesheet\"", "@import", "sourceMappingURL"})
        CHECK_MESSAGE(page.find(word) == std::string_view::npos, std::string(word));
}
