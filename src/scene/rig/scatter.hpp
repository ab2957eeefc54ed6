#pragma once
#include <optional>
#include <vector>

#include <luciole/scene.hpp>

#include "scene/json.hpp"
#include "scene/random.hpp"

namespace luciole::rig {

/// Gives a light a new colour, a new intensity, or both: `light.color` becomes their product. Where only one is given
/// the other is the light's own: its largest channel is its intensity.
void recolor(Light& light, const std::optional<vec3>& color, const std::optional<double>& intensity,
             const JsonNode& source);

/// A rig's recipe for many lights from one entry: where they are and what differs between them. The same recipe makes
/// the same lights on every machine.
class Scatter {
public:
    /// \param scene for `"box": "bounds"`
    Scatter(const JsonNode& node, const Scene& scene);

    uint32_t count() const { return count_; }
    /// Position of light `index`. Call once per light, in order, each followed by one `vary`.
    vec3 place(uint32_t index);
    /// Colour, intensity and range, as far as the recipe varies them.
    void vary(Light& light);

private:
    vec3 pickColor();

    JsonNode node_;
    uint32_t count_;
    Random random_;
    bool onLine_;
    dvec3 low_, high_;  ///< corners of the box, or ends of the line
    double jitter_ = 0;
    std::vector<vec3> palette_;
    std::optional<dvec2> hue_;  ///< degrees
    double saturation_ = 1;
    std::optional<dvec2> intensity_, range_;
};

}  // namespace luciole::rig
