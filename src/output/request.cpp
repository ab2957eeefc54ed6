#include "output/request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <luciole/error.hpp>

namespace luciole {

const std::vector<std::string>& aovNames() {
    static const std::vector<std::string> names{"depth", "normal", "cs0", "cs1", "material", "id", "light-count",
                                                "evaluations", "useful-evaluations", "light-fingerprint", "list-length", "list-slice"};
    return names;
}

bool isListLayer(const std::string& aov) { return aov == "list-length" || aov == "list-slice"; }

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

std::string whyNoBounce(const Light& light) {
    if (light.type != LightType::spot) return light.type == LightType::point ? "a point light" : "a directional light";
    if (!(light.outerConeAngle < kWidestBounce)) return fmt::format("which has {} rad", light.outerConeAngle);
    if (light.volume != kNone) return "which a mesh bounds";
    return light.contribution == LightContribution::specularOnly ? "which lights highlights only" : "";
}

std::optional<uint32_t> bouncingLight(std::span<const Light> lights, const RenderSettings& settings) {
    const std::string& wanted = settings.bounceLight;
    if (wanted == "none") return std::nullopt;
    auto index = uint32_t(std::ranges::find(lights, wanted, &Light::name) - lights.begin());
    if (index == lights.size()) {
        const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
        if (code != std::errc() || end != wanted.data() + wanted.size() || index >= lights.size())
            throw Error(ErrorKind::usage, fmt::format("bounce-light: expected none, a light's name or its index below {}, got \"{}\"",
                                                      lights.size(), wanted));
    }
    if (const std::string why = whyNoBounce(lights[index]); !why.empty())
        throw Error(ErrorKind::usage, fmt::format("bounce-light: expected a spot light with an outer cone angle below {} rad that no mesh "
                                                  "bounds and that lights more than highlights, got \"{}\", {}", kWidestBounce, wanted, why));
    return index;
}

}  // namespace luciole
