# cmake -D INPUT=FILE -D OUTPUT=SOURCE -P embed.cmake: writes C++ that holds the file's bytes; none if INPUT is empty.
set(bytes "")
if(INPUT)
    file(READ ${INPUT} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
endif()
file(WRITE ${OUTPUT} "// Made by apps/report/embed.cmake.
#include \"report_template.hpp\"

namespace luciole {
namespace {
constexpr unsigned char kTemplate[] = {
${bytes}
0};
}  // namespace

std::string_view reportTemplate() { return {reinterpret_cast<const char*>(kTemplate), sizeof(kTemplate) - 1}; }

}  // namespace luciole
")
