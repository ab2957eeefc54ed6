#pragma once
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <luciole/renderer.hpp>

#include "image_difference.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::test {

/// Options for core and synchronization validation, and the end of a test that must not have heard from it.
class SilentValidation {
public:
    SilentValidation() = default;
    SilentValidation(const SilentValidation&) = delete;
    ~SilentValidation() {
        for (const std::string& message : messages_) FAIL_CHECK("validation: " << message);
    }
    RendererOptions options() {
        return {.validation = true, .onMessage = [this](std::string_view text) { messages_.emplace_back(text); }};
    }

private:
    std::vector<std::string> messages_;
};

/// A renderer under validation. Each test that uses one fails if anything was said.
class ValidatedRenderer {
public:
    ValidatedRenderer() : renderer_(validation_.options()) {}
    Renderer* operator->() { return &renderer_; }
    Frame render(const Scene& scene, const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs = {}) {
        renderer_.setScene(scene);
        return renderer_.render(view, settings, aovs);
    }

private:
    SilentValidation validation_;  // outlives the renderer that reports to it
    Renderer renderer_;
};

/// light-prepass rounds normals to 16 bits a coordinate of the octahedron, a vector (x, y, 1 - |x| - |y|) as short as 1 / sqrt 3: by half
/// a step of 2 / 65535 in x and y they turn by at most sqrt 6 sqrt 3 / 65535. Light changes by that times the slope of its equation: as
/// of a cosine mostly, and in the highlight of a surface of roughness 0.2 as 2 / alpha, 50.
inline constexpr double kNormalTurn = 4.25 / 65535;
inline constexpr double kSteepest = 50;

/// Checks that a technique's picture is the yardstick's but for rounding. \param lights of the scene
inline void checkAlike(const render::LightingTechnique& technique, const Image& image, const Image& yardstick,
                       const std::vector<bool>& mask, size_t lights) {
    const ErrorSummary radiance = difference(image, yardstick, &mask);
    CHECK(radiance.share > 0.9);
    if (technique.info.name == "light-prepass") {
        // What else it rounds, a test of its own shows.
        CHECK(radiance.mean <= kNormalTurn);
        CHECK(radiance.p999 <= kSteepest * kNormalTurn);
    } else {
        // Sums of n positive terms in any order differ by at most 2 n units of roundoff (2^-24).
        CHECK(radiance.max <= 2.0 * double(lights + 1) * std::exp2(-24));
    }
}

/// What each technique is held to, in one view of the scene that was set.
class Yardsticks {
public:
    Yardsticks(ValidatedRenderer& renderer, const View& view, const RenderSettings& settings, std::vector<std::string> aovs = {})
        : renderer_(renderer), view_(view), settings_(settings), aovs_(std::move(aovs)) {}
    const Frame& of(const render::LightingTechnique& technique) { return named(render::yardstickOf(technique), aovs_); }

    /// Pixels at which the technique has to give what the yardstick gives. Of surfaces that coincide, to the bit, one is seen; but
    /// forward-multipass adds them all, and all are counted where they are drawn, so that forward techniques are not held to them. Such
    /// pixels evaluate more lights than there are, as do those behind surfaces that blend: a scene has the one or the other.
    std::vector<bool> comparable(const render::LightingTechnique& technique, const Scene& scene) {
        std::vector<bool> pixels(size_t(view_.extent.x) * view_.extent.y, true);
        const bool blends = std::ranges::any_of(scene.materials, [](const Material& material) { return material.alphaMode == AlphaMode::blend; });
        if (!technique.forward || blends) return pixels;
        const Image& evaluations = named("forward-loop", {"evaluations"}).aovs.at("evaluations");
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = evaluations.data[i] <= float(scene.lights.size());
        return pixels;
    }

private:
    const Frame& named(const std::string& name, const std::vector<std::string>& aovs) {
        const auto key = std::pair(name, aovs);
        if (!frames_.contains(key)) {
            settings_.lighting = name;
            frames_[key] = renderer_->render(view_, settings_, aovs);
        }
        return frames_.at(key);
    }

    ValidatedRenderer& renderer_;
    View view_;
    RenderSettings settings_;
    std::vector<std::string> aovs_;
    std::map<std::pair<std::string, std::vector<std::string>>, Frame> frames_;
};

}  // namespace luciole::test
