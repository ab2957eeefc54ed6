#include "scene/builtin/lighting.hpp"

#include <algorithm>
#include <cmath>

#include "scene/visibility.hpp"

namespace luciole {

namespace {

/// Lights sorted into the cells of a regular grid, about one light per cell.
class LightGrid {
public:
    explicit LightGrid(const std::vector<Light>& lights) : lights_(lights) {
        low_ = high_ = lights.front().positionWorld;
        for (const Light& light : lights) {
            low_ = glm::min(low_, light.positionWorld);
            high_ = glm::max(high_, light.positionWorld);
        }
        const vec3 size = glm::max(high_ - low_, vec3(1e-3f));
        cell_ = std::cbrt(size.x * size.y * size.z / float(lights.size()));
        for (int axis = 0; axis < 3; ++axis) count_[axis] = std::clamp(int(size[axis] / cell_) + 1, 1, 1024);
        sort();
    }

    vec3 low() const { return low_; }
    vec3 high() const { return high_; }

    /// Calls use(light, squared distance) for each light nearer to `point` than `range`.
    template <class Use>
    void forEachWithin(vec3 point, float range, const Use& use) const {
        const glm::ivec3 first = cellOf(point - range), last = cellOf(point + range);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y) {
                // The cells of a row stand side by side, so their lights do too.
                const uint32_t begin = starts_[index({first.x, y, z})], end = starts_[index({last.x, y, z}) + 1];
                for (uint32_t i = begin; i < end; ++i) {
                    const vec3 away = positions_[i] - point;
                    const float squared = glm::dot(away, away);
                    if (squared < range * range) use(lights_[order_[i]], squared);
                }
            }
    }

private:
    glm::ivec3 cellOf(vec3 point) const {
        const vec3 cell = (point - low_) / cell_;
        return glm::ivec3(glm::clamp(glm::floor(cell), vec3(0), vec3(count_ - 1)));
    }
    size_t index(glm::ivec3 cell) const {
        return (size_t(cell.z) * size_t(count_.y) + size_t(cell.y)) * size_t(count_.x) + size_t(cell.x);
    }

    void sort() {
        starts_.assign(size_t(count_.x) * size_t(count_.y) * size_t(count_.z) + 1, 0);
        for (const Light& light : lights_) ++starts_[index(cellOf(light.positionWorld)) + 1];
        for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
        order_.resize(lights_.size());
        positions_.resize(lights_.size());
        std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (uint32_t i = 0; i < lights_.size(); ++i) {
            const uint32_t slot = next[index(cellOf(lights_[i].positionWorld))]++;
            order_[slot] = i;
            positions_[slot] = lights_[i].positionWorld;
        }
    }

    const std::vector<Light>& lights_;
    vec3 low_{0}, high_{0};
    float cell_ = 1;
    glm::ivec3 count_{1};
    std::vector<uint32_t> starts_;  ///< per cell: where its lights begin; the end of the last one closes the list
    std::vector<uint32_t> order_;   ///< indices of lights, cell by cell
    std::vector<vec3> positions_;   ///< of the same lights
};

/// Square root of the spot's falloff, [0, 1]; 1 for a point light.
float coneShare(const Light& light, vec3 point) {
    if (light.type != LightType::spot) return 1;
    const float c = glm::dot(glm::normalize(point - light.positionWorld), light.directionWorld);
    const float outer = std::cos(light.outerConeAngle);
    return std::clamp((c - outer) / std::max(0.001f, std::cos(light.innerConeAngle) - outer), 0.0f, 1.0f);
}

double meanOverlap(const LightGrid& grid, const std::vector<VisiblePoint>& points, float range) {
    uint64_t reached = 0;
    for (const VisiblePoint& point : points)
        grid.forEachWithin(point.positionWorld, range, [&](const Light& light, float) {
            if (coneShare(light, point.positionWorld) > 0) ++reached;
        });
    return double(reached) / double(points.size());
}

/// No visible point is farther from any light.
float farthest(const LightGrid& grid, const std::vector<VisiblePoint>& points) {
    vec3 low = grid.low(), high = grid.high();
    for (const VisiblePoint& point : points) {
        low = glm::min(low, point.positionWorld);
        high = glm::max(high, point.positionWorld);
    }
    return glm::distance(low, high) * 1.001f;
}

/// Lambert: luminance of what `point` shows.
double radianceAt(const LightGrid& grid, const VisiblePoint& point, float range) {
    double sum = 0;
    grid.forEachWithin(point.positionWorld, range, [&](const Light& light, float squared) {
        const float d2 = std::max(squared, 1e-4f);
        const vec3 toLight = (light.positionWorld - point.positionWorld) / std::sqrt(d2);
        const float share = d2 / (range * range), cone = coneShare(light, point.positionWorld);
        const float attenuation = std::max(1 - share * share, 0.0f) / d2 * cone * cone;
        const float luminance = glm::dot(light.color, vec3(0.2126f, 0.7152f, 0.0722f));
        sum += double(luminance * attenuation * std::max(glm::dot(point.normalWorld, toLight), 0.0f));
    });
    return sum * double(point.albedo) / kPi;
}

}  // namespace

std::vector<VisiblePoint> visiblePoints(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height) {
    const Visibility visibility(scene);
    const dmat4 worldFromView(camera.worldFromView);
    const dvec3 eye(worldFromView[3]);
    const double halfHeight = std::tan(double(camera.yFov) / 2), aspect = double(width) / height;
    std::vector<VisiblePoint> points;
    points.reserve(size_t(width) * height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const dvec2 ndc(2 * (x + 0.5) / width - 1, 1 - 2 * (y + 0.5) / height);
            const dvec3 direction(worldFromView * dvec4(ndc.x * halfHeight * aspect, ndc.y * halfHeight, -1, 0));
            const auto hit = visibility.closest(eye, direction, double(camera.zNear));
            if (!hit) continue;
            const auto corners = visibility.triangleWorld(hit->object, hit->triangle);
            const dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            const vec4 color = scene.materials[scene.objects[hit->object].material].baseColor;
            points.push_back({.positionWorld = vec3(eye + hit->t * direction),
                              .normalWorld = vec3(glm::dot(normal, direction) > 0 ? -normal : normal),
                              .albedo = glm::dot(vec3(color), vec3(0.2126f, 0.7152f, 0.0722f))});
        }
    return points;
}

double fitRange(std::vector<Light>& lights, const std::vector<VisiblePoint>& points, double overlap) {
    if (lights.empty() || points.empty()) return 0;
    const LightGrid grid(lights);
    const float most = farthest(grid, points);
    // Upwards from a small range first: counting takes time in proportion to what is counted.
    float low = 0, high = std::min(most, 0.01f);
    while (high < most && meanOverlap(grid, points, high) < overlap) {
        low = high;
        high = std::min(1.5f * high, most);
    }
    while (high - low > 1e-4f * high) {
        const float middle = 0.5f * (low + high);
        (meanOverlap(grid, points, middle) < overlap ? low : high) = middle;
    }
    for (Light& light : lights) light.range = high;
    return meanOverlap(grid, points, high);
}

void fitBrightness(std::vector<Light>& lights, const std::vector<VisiblePoint>& points, double radiance) {
    if (lights.empty()) return;
    const LightGrid grid(lights);
    std::vector<double> lit;
    for (const VisiblePoint& point : points)
        if (const double value = radianceAt(grid, point, lights.front().range); value > 0) lit.push_back(value);
    if (lit.empty()) return;
    const auto mean = [&](double scale) {
        double sum = 0;
        for (const double value : lit) sum += std::min(scale * value, 1.0);
        return sum / double(lit.size());
    };
    double low = 0, high = 1e-6;
    while (mean(high) < radiance) high *= 4;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        (mean(middle) < radiance ? low : high) = middle;
    }
    for (Light& light : lights) light.color *= float(high);
}

}  // namespace luciole
