#include "output/request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <luciole/error.hpp>

namespace luciole {

const std::vector<std::string>& aovNames() {
    static const std::vector<std::string> names{"depth", "normal", "cs0", "cs1", "material", "id", "light-count",
                                                "evaluations", "useful-evaluations", "light-fingerprint"};
    return names;
}

void checkRequest(const View& view, const std::vector<std::string>& aovs) {
    for (const uint32_t side : {view.extent.x, view.extent.y})
        if (side < 1 || side > kMaxPictureSide)
            throw Error(ErrorKind::usage, fmt::format("size: expected 1 to {} pixels a side, got {}x{}", kMaxPictureSide,
                                                      view.extent.x, view.extent.y));
    try {
        validate(view.camera);
    } catch (const Error& error) {
        throw Error(ErrorKind::usage, fmt::format("view: {}", error.what()));
    }
    for (const std::string& name : aovs)
        if (std::ranges::find(aovNames(), name) == aovNames().end())
            throw Error(ErrorKind::usage,
                        fmt::format("aov: expected one of {}, got \"{}\"", fmt::join(aovNames(), ", "), name));
}

}  // namespace luciole
