#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/advice.hpp>
#include <luciole/settings.hpp>

#include "render/lighting/techniques.hpp"

/// The choice between lighting techniques: what a frame costs, as a sum of counts times coefficients, and which techniques may be
/// chosen. Needs no device. docs/techniques/auto.md
namespace luciole::render {

inline constexpr uint32_t kCostModelVersion = 2;  ///< raised with any change of what a coefficient means

/// A count that a technique's time depends on, and the name of what one of it costs. Techniques that share a name share the coefficient.
struct CostTerm {
    std::string_view coefficient;
    double (*count)(const SceneCounts& counts, const RenderSettings& settings);
};

/// What a frame of a technique does, as far as it takes time; a row for each technique that may be chosen.
struct CostModel {
    std::string_view technique;
    std::vector<CostTerm> terms;
    bool evaluatesAll() const;  ///< all lights at every pixel, so that it takes long where there are many of both
};
const std::vector<CostModel>& costModels();

/// Milliseconds for one of what the coefficient counts, by name.
using Coefficients = std::map<std::string, double, std::less<>>;

/// A frame that was measured.
struct CostSample {
    std::string technique;
    SceneCounts counts;
    double ms;
};

/// The coefficients, none below 0, that predict the samples with least relative errors, outliers apart. Samples of techniques without a
/// model are left out.
Coefficients fit(std::span<const CostSample> samples, const RenderSettings& settings);

/// \return nothing if there is no model, or a coefficient of it is not known
std::optional<double> predictedMs(std::string_view technique, const SceneCounts& counts, const RenderSettings& settings,
                                  const Coefficients& coefficients);

/// Whether the coefficients are those of all models of techniques that take the settings.
bool coversModels(const Coefficients& coefficients, const RenderSettings& settings);

/// What else decides whether a technique may be chosen.
struct Circumstances {
    uint32_t lights = 0;    ///< in the tables, those of a bounce included
    bool bounce = false;    ///< lights are made on the device
    bool samples = true;    ///< the device shades four samples a pixel
    bool feedback = true;   ///< the device can sample what it draws into
    bool points = true;     ///< the device draws points as large as a tile, that bring along enough
    bool lists = false;     ///< layers of lists of lights are asked for
};

/// Why the technique may not be chosen: it refuses the settings, or it may differ from its yardstick by more than the rounding of
/// sums; empty if it may.
std::string whyNot(const LightingTechnique& technique, const RenderSettings& settings, const Circumstances& circumstances);

/// All techniques, and the choice: of those that may be chosen the one that is predicted to be fastest, or, where nothing can be
/// predicted, the first of brute-force and forward-loop that may be.
/// \throws Error(usage) if no technique can do with the settings
LightingAdvice advise(const SceneCounts& counts, const RenderSettings& settings, const Circumstances& circumstances,
                      const Coefficients& coefficients);

/// The coefficients on one line, and back; nothing for anything but such a line, with numbers that are finite and not negative.
std::string textOf(const Coefficients& coefficients);
std::optional<Coefficients> coefficientsFrom(std::string_view text);

}  // namespace luciole::render
