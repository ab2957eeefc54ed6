#pragma once
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <luciole/renderer.hpp>

namespace luciole::test {

/// A renderer under core and synchronization validation. Each test that uses one ends by checking that nothing was said.
class ValidatedRenderer {
public:
    ValidatedRenderer() : renderer_({.validation = true, .onMessage = [this](std::string_view text) { messages_.emplace_back(text); }}) {}
    ValidatedRenderer(const ValidatedRenderer&) = delete;
    ~ValidatedRenderer() {
        for (const std::string& message : messages_) FAIL_CHECK("validation: " << message);
    }
    Renderer* operator->() { return &renderer_; }
    Frame render(const Scene& scene, const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs = {}) {
        renderer_.setScene(scene);
        return renderer_.render(view, settings, aovs);
    }

private:
    std::vector<std::string> messages_;  // outlives the renderer that reports into it
    Renderer renderer_;
};

}  // namespace luciole::test
