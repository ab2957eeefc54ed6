#pragma once
#include <array>
#include <vector>

#include <luciole/scene.hpp>

namespace luciole::reference {

/// A light volume, made ready for many points.
class Volume {
public:
    explicit Volume(const LightVolume& volume);

    /// Whether the surface winds about the point. On the surface itself either answer may come.
    bool contains(dvec3 positionWorld) const;

private:
    int windingNumber(dvec3 positionWorld) const;

    dvec3 low_, high_;
    std::vector<std::array<dvec3, 3>> triangles_;
};

/// All of a scene's light volumes, in its order.
std::vector<Volume> volumesOf(const Scene& scene);

}  // namespace luciole::reference
