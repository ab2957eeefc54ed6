#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <luciole/renderer.hpp>

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

/// What each technique is held to, in one view of the scene that was set.
class Yardsticks {
public:
    Yardsticks(ValidatedRenderer& renderer, const View& view, const RenderSettings& settings, std::vector<std::string> aovs = {})
        : renderer_(renderer), view_(view), settings_(settings), aovs_(std::move(aovs)) {}
    const Frame& of(const render::LightingTechnique& technique) { return named(render::yardstickOf(technique), aovs_); }

    /// Pixels at which the technique's picture has to be the yardstick's: all but those where surfaces coincide, to the bit, if it draws
    /// them once for each light and adds up: there it adds them all. \param lights of the scene: what a surface evaluates
    std::vector<bool> comparable(const render::LightingTechnique& technique, size_t lights) {
        std::vector<bool> pixels(size_t(view_.extent.x) * view_.extent.y, true);
        if (technique.info.name != "forward-multipass") return pixels;
        const Image& evaluations = named("forward-loop", {"evaluations"}).aovs.at("evaluations");
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = evaluations.data[i] <= float(lights);
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
