#include "reference/lights.hpp"

#include <algorithm>
#include <cmath>

namespace luciole::reference {
LightSource::LightSource(const Scene& scene, const FunctionTables& tables, const std::vector<Volume>& volumes,
                         const Light& light)
    : type_(light.type),
      contribution_(light.contribution),
      infiniteViewer_(light.infiniteViewer && light.type == LightType::directional),
      castsShadows_(light.castsShadows),
      position_(light.positionWorld),
      direction_(normalize(dvec3(light.directionWorld))),
      color_(light.color),
      range_(light.range),
      rangeSquared_(range_ * range_),
      cosInner_(std::cos(double(light.innerConeAngle))),
      cosOuter_(std::cos(double(light.outerConeAngle))),
      attenuation_(light.attenuation == kNone ? nullptr : &tables.ofDistance(light.attenuation)),
      falloff_(light.falloff == kNone ? nullptr : &tables.ofCosine(light.falloff)),
      litObjects_(light.linkGroup == kNone ? nullptr : &scene.linkGroups[light.linkGroup].litObjects),
      castingObjects_(light.linkGroup == kNone ? nullptr : &scene.linkGroups[light.linkGroup].castingObjects),
      volume_(light.volume == kNone ? nullptr : &volumes[light.volume]) {}

std::optional<Arrival> LightSource::arrivalAt(dvec3 positionWorld) const {
    const auto arrival = unboundedArrivalAt(positionWorld);
    // Last, as it costs most.
    return arrival && volume_ && !volume_->contains(positionWorld) ? std::nullopt : arrival;
}

std::optional<Arrival> LightSource::unboundedArrivalAt(dvec3 positionWorld) const {
    if (type_ == LightType::directional) return Arrival{-direction_, color_};
    const dvec3 toLight = position_ - positionWorld;
    const double distanceSquared = dot(toLight, toLight);
    if (distanceSquared >= rangeSquared_) return std::nullopt;
    const double distance = std::sqrt(distanceSquared);
    const dvec3 L = distance > 0 ? toLight / distance : dvec3(0);
    if (type_ == LightType::point) return Arrival{L, color_ * attenuation(distance)};
    const double cosine = dot(direction_, -L);
    if (cosine <= cosOuter_) return std::nullopt;
    return Arrival{L, color_ * attenuation(distance) * falloff(cosine)};
}

namespace {

bool holds(const std::vector<bool>* objects, uint32_t objectId) { return !objects || (objectId < objects->size() && (*objects)[objectId]); }

}  // namespace

bool LightSource::touches(uint32_t objectId) const { return holds(litObjects_, objectId); }
bool LightSource::isCastBy(uint32_t objectId) const { return holds(castingObjects_, objectId); }

LightSource::Path LightSource::pathFrom(dvec3 positionWorld) const {
    if (type_ == LightType::directional) return {-direction_, HUGE_VAL};
    const dvec3 toLight = position_ - positionWorld;
    const dvec3 along = abs(toLight);
    return {toLight, 1 - kShadowNear / std::max({along.x, along.y, along.z})};
}

// glTF KHR_lights_punctual, "Range Property". A function replaces it: Calver 2003, "Shaped Lights".
double LightSource::attenuation(double distance) const {
    if (attenuation_) return (*attenuation_)(distance / range_).x;
    const double d = std::max(distance, 0.01);
    const double share = d * d / rangeSquared_;
    return std::clamp(1 - share * share, 0.0, 1.0) / (d * d);
}

// glTF KHR_lights_punctual, "Inner and Outer Cone Angles". A function replaces it: Calver 2003, "Shaped Lights".
double LightSource::falloff(double cosine) const {
    if (falloff_) return (*falloff_)(cosine).x;
    const double edge = std::clamp((cosine - cosOuter_) / std::max(0.001, cosInner_ - cosOuter_), 0.0, 1.0);
    return edge * edge;
}

std::vector<LightSource> lightSources(const Scene& scene, const FunctionTables& tables,
                                      const std::vector<Volume>& volumes) {
    std::vector<LightSource> result;
    result.reserve(scene.lights.size());
    for (const Light& light : scene.lights) result.emplace_back(scene, tables, volumes, light);
    return result;
}

}  // namespace luciole::reference
