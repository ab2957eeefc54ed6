#pragma once
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <luciole/renderer.hpp>

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

}  // namespace luciole::test
