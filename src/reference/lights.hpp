#pragma once
#include <optional>
#include <vector>

#include <luciole/scene.hpp>

#include "reference/function_table.hpp"
#include "reference/light_model.hpp"
#include "reference/volume.hpp"

namespace luciole::reference {

/// A light, made ready for many points.
class LightSource {
public:
    /// \param scene, tables, volumes must outlive this object
    LightSource(const Scene& scene, const FunctionTables& tables, const std::vector<Volume>& volumes, const Light& light);

    /// What arrives at a point in range, in the cone and in the volume; nothing elsewhere. Links are not looked at.
    std::optional<Arrival> arrivalAt(dvec3 positionWorld) const;

    bool touches(uint32_t objectId) const;
    bool castsShadows() const { return castsShadows_; }
    /// Whether the object keeps this light off what lies behind it, if its material does.
    bool isCastBy(uint32_t objectId) const;
    /// The way from a point to the light, or to where nothing is too near to it to cast: at most t = 1 of `path`; directional: infinitely far.
    struct Path {
        dvec3 path;
        double tMax;
    };
    Path pathFrom(dvec3 positionWorld) const;
    LightContribution contribution() const { return contribution_; }
    bool infiniteViewer() const { return infiniteViewer_; }

private:
    /// As `arrivalAt`, whatever the volume.
    std::optional<Arrival> unboundedArrivalAt(dvec3 positionWorld) const;
    double attenuation(double distance) const;
    double falloff(double cosine) const;

    LightType type_;
    LightContribution contribution_;
    bool infiniteViewer_, castsShadows_;
    dvec3 position_, direction_, color_;
    double range_, rangeSquared_;
    double cosInner_, cosOuter_;
    const FunctionTable *attenuation_, *falloff_;  ///< null: glTF's
    const std::vector<bool>*litObjects_, *castingObjects_;  ///< null: all
    const Volume* volume_;                         ///< null: everywhere
};

std::vector<LightSource> lightSources(const Scene& scene, const FunctionTables& tables,
                                      const std::vector<Volume>& volumes);

}  // namespace luciole::reference
