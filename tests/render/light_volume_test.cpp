#include "render/lighting/light_volume.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <doctest/doctest.h>
#include <luciole/renderer.hpp>

#include "render/tables.hpp"

// The derivations that these tests hold the code to: docs/techniques/light-volumes.md.

using namespace luciole;
using doctest::Approx;
using shared::LightConstants;
using shared::LightShape;
using shared::ViewConstants;

namespace {

/// What the floats of light_volume.shared.h may be off, relative to the farthest distance that enters: a quarter of the
/// 4e-6 by which viewSlack enlarges every shape for that reason, some 16 units of roundoff.
constexpr double kRounding = 1e-6;

struct Random {
    std::mt19937_64 bits{7};
    double between(double low, double high) { return low + (high - low) * double(bits() >> 11) * 0x1p-53; }
    double logBetween(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    dvec3 direction() {
        const double z = between(-1, 1), azimuth = between(0, 2 * kPi), s = std::sqrt(1 - z * z);
        return {s * std::cos(azimuth), s * std::sin(azimuth), z};
    }
};

/// Two unit vectors at right angles to `axis` and to each other.
std::pair<dvec3, dvec3> across(dvec3 axis) {
    const dvec3 u = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    return {u, glm::cross(axis, u)};
}

double reach(const LightShape& shape) { return double(glm::length(shape.apex)) + double(shape.radius); }

/// \param away how far the apex may be from the origin, in radii
LightShape randomShape(Random& random, double angle, double away) {
    const double radius = random.logBetween(0.01, 1000);
    return {vec3(random.direction() * random.between(0, away) * radius), vec3(random.direction()), float(radius), float(angle)};
}

/// The angles between directions that tests go through: thin and wide, on both sides of each case of the formulas.
constexpr std::array kAngles{0.001, 0.02, 0.3, 0.785, 0.786, 1.0, 1.4, 1.57, 1.58, 2.0, 2.6, 3.1, kPi};

/// The farthest that the shape as it is drawn, the convex hull of the sector, reaches from its apex in a direction.
double support(const LightShape& shape, dvec3 direction) {
    const double angle = shape.angle;
    const double off = std::acos(std::clamp(glm::dot(glm::normalize(direction), glm::normalize(dvec3(shape.axis))), -1.0, 1.0));
    if (off <= angle) return shape.radius;                    // a point of the ball
    const double rim = shape.radius * std::cos(off - angle);  // the point of the rim that lies nearest to the direction
    return angle < kPi / 2 ? std::max(rim, 0.0) : rim;
}

/// A point of the sector; one of three at its very edge.
dvec3 pointOf(Random& random, const LightShape& shape) {
    const bool edge = random.between(0, 1) < 1.0 / 3;
    const double distance = shape.radius * (edge || random.between(0, 1) < 0.3 ? 1 : random.between(0, 1));
    const double angle = shape.angle * (edge ? 1 : random.between(0, 1));
    const double azimuth = random.between(0, 2 * kPi);
    const dvec3 axis = glm::normalize(dvec3(shape.axis));
    const auto [u, v] = across(axis);
    return dvec3(shape.apex) +
           distance * (std::cos(angle) * axis + std::sin(angle) * (std::cos(azimuth) * u + std::sin(azimuth) * v));
}

ViewConstants perspective(float zNear, uvec2 extent = {1, 1}, float yFov = float(kPi / 2)) {
    return render::viewConstants({{.yFov = yFov, .zNear = zNear}, extent}, {});
}

/// The extreme of x / depth over the points with depth >= zNear of a disc, found by bisection: whether a line through the eye
/// meets them is one quadratic equation, and the slopes of those that do are an interval.
double extremeSlope(double x, double depth, double radius, double zNear, double side) {
    const auto meets = [&](double slope) {  // the points (slope d, d) within the radius of (x, depth)
        const double a = 1 + slope * slope, b = slope * x + depth;
        const double off = slope * depth - x;  // discriminant b^2 - a (x^2 + depth^2 - r^2), without cancellation
        const double root = a * radius * radius - off * off;
        return root >= 0 && (b + std::sqrt(root)) / a >= zNear;
    };
    double inside = x / std::max(depth + radius, zNear);
    double outside = side * ((std::abs(x) + radius) / zNear + 1);
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (inside + outside);
        (meets(middle) ? inside : outside) = middle;
    }
    return inside;
}

struct Ball {
    dvec3 center;  ///< depth instead of z
    double radius, zNear;
};

/// A ball that reaches the near plane: the eye outside, inside, or close to its surface.
Ball randomBall(Random& random) {
    Ball ball{};
    do {
        ball.radius = float(random.logBetween(0.01, 1e4));
        ball.zNear = float(random.logBetween(0.001, 1));
        const double distance = random.between(0, 1) < 0.3 ? 1 + random.between(-0.001, 0.001) : random.logBetween(0.01, 100);
        ball.center = dvec3(vec3(random.direction() * distance * ball.radius));
    } while (ball.center.z + ball.radius < ball.zNear * 1.001);
    return ball;
}

vec4 boundsOf(const Ball& ball) {
    ViewConstants view = perspective(float(ball.zNear));
    view.clipScale = vec2(1);
    const vec4 bounds = projectedBounds(view, vec4(vec2(ball.center), -ball.center.z, ball.radius));
    return {bounds.x, -bounds.w, bounds.z, -bounds.y};  // with y up, as the slopes are
}

struct Polyhedron {
    std::vector<dvec3> vertices;
    std::vector<uint32_t> indices;
};

Polyhedron meshOf(const LightShape& shape, uint32_t lod) {
    static const std::vector<uint32_t> all = render::volumeIndices();
    const auto first = all.begin() + shared::volumeFirstIndex(lod);
    Polyhedron mesh{{}, {first, first + shared::volumeIndexCount(lod)}};
    const uint32_t count = *std::ranges::max_element(mesh.indices) + 1;
    for (uint32_t i = 0; i < count; ++i) mesh.vertices.push_back(dvec3(volumeVertex(shape, lod, i)));
    return mesh;
}

struct Plane {
    dvec3 normal;     ///< unit, outwards if the triangle runs counter-clockwise seen from outside
    double distance;  ///< from the shape's apex
};

/// The planes of the mesh's triangles, but for those that shrink to a line or point at the pole of a ball.
std::vector<Plane> planesOf(const Polyhedron& mesh, const LightShape& shape) {
    // The smallest true triangles, at the end of the axis, have an area of 3e-3 times this.
    const double negligible = 1e-6 * std::pow(double(shape.angle) * shape.radius, 2);
    std::vector<Plane> planes;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const dvec3 a = mesh.vertices[mesh.indices[i]], b = mesh.vertices[mesh.indices[i + 1]], c = mesh.vertices[mesh.indices[i + 2]];
        const dvec3 normal = glm::cross(b - a, c - a);
        if (0.5 * glm::length(normal) > negligible)
            planes.push_back({glm::normalize(normal), glm::dot(glm::normalize(normal), a - dvec3(shape.apex))});
    }
    return planes;
}

/// Mean area of the mesh's projection in all directions (Cauchy: a quarter of a convex body's surface).
double meanProjectedArea(const Polyhedron& mesh) {
    double surface = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const dvec3 a = mesh.vertices[mesh.indices[i]];
        surface += 0.5 * glm::length(glm::cross(mesh.vertices[mesh.indices[i + 1]] - a, mesh.vertices[mesh.indices[i + 2]] - a));
    }
    return surface / 4;
}

LightConstants lightOf(const LightShape& shape) {
    LightConstants light{};
    light.type = shape.angle < float(kPi) ? shared::kLightSpot : shared::kLightPoint;
    light.position = shape.apex;
    light.direction = shape.axis;
    light.range = shape.radius;
    light.cosOuter = std::cos(shape.angle);
    return light;
}

View randomView(Random& random, bool orthographic) {
    const double zNear = random.logBetween(0.001, 1);
    const Camera camera{.orthographic = orthographic,
                        .yFov = float(random.between(0.1, 2.5)),
                        .halfHeight = float(random.logBetween(0.1, 100)),
                        .zNear = float(zNear),
                        .zFar = float(zNear + random.logBetween(1, 1000))};
    return {camera, {1 + random.bits() % 9, 1 + random.bits() % 9}};
}

/// Whether a surface that the camera may show at a pixel's centre, at least at one of some depths, is in the sector.
bool seen(const View& view, const LightShape& shape) {
    const dmat4 clip = render::clipFromView(view.camera, double(view.extent.x) / view.extent.y);
    const dvec3 apex(shape.apex), axis = glm::normalize(dvec3(shape.axis));
    for (uint32_t y = 0; y < view.extent.y; ++y)
        for (uint32_t x = 0; x < view.extent.x; ++x) {
            const dvec2 across((2 * (x + 0.5) / view.extent.x - 1) / clip[0][0], (2 * (y + 0.5) / view.extent.y - 1) / clip[1][1]);
            // Points origin + t * along with depth t.
            const dvec3 origin = view.camera.orthographic ? dvec3(across, 0) : dvec3(0);
            const dvec3 along = view.camera.orthographic ? dvec3(0, 0, -1) : dvec3(across, -1);
            const double a = glm::dot(along, along), b = glm::dot(along, apex - origin);
            const dvec3 off = apex - origin - along * (b / a);
            const double root = double(shape.radius) * shape.radius - glm::dot(off, off);
            if (root < 0) continue;
            const double first = std::max(b / a - std::sqrt(root / a), double(view.camera.zNear)), last = b / a + std::sqrt(root / a);
            for (int i = 0; i <= 32 && first <= last; ++i) {
                const dvec3 fromApex = origin + along * (first + (last - first) * i / 32) - apex;
                if (glm::dot(fromApex, axis) >= std::cos(double(shape.angle)) * glm::length(fromApex)) return true;
            }
        }
    return false;
}

}  // namespace

TEST_CASE("projected ball: on the axis its bounds are the tangents' slopes, tan(asin(r / d))") {
    const vec4 bounds = boundsOf({{0, 0, 5}, 3, 0.1});
    const double slope = std::tan(std::asin(3.0 / 5));  // 3 / 4
    for (int side = 0; side < 4; ++side) CHECK(bounds[side] == Approx(side < 2 ? -slope : slope).epsilon(1e-6));
}

TEST_CASE("projected ball: bounds scale with the field of view, and y points down") {
    const ViewConstants view = perspective(0.1f, {2, 1}, 1);
    const vec4 bounds = projectedBounds(view, vec4(1, 2, -10, 0.001f));
    const double f = 1 / std::tan(0.5);
    CHECK(bounds.x == Approx(f / 2 * 0.1).epsilon(2e-3));  // the radius is a thousandth of x
    CHECK(bounds.y == Approx(-f * 0.2).epsilon(2e-3));
    CHECK(bounds.x < bounds.z);
    CHECK(bounds.y < bounds.w);
}

TEST_CASE("projected ball: where the near plane cuts off the tangents' points of touch, the edge of the cut bounds it") {
    // The plane depth = 1 cuts a disc of radius 4 from the ball of radius 5 at depth 4; the tangent would touch nearer.
    const vec4 bounds = boundsOf({{0, 0, 4}, 5, 1});
    for (int side = 0; side < 4; ++side) CHECK(bounds[side] == Approx(side < 2 ? -4 : 4).epsilon(1e-6));
    // A ball around a point beside the eye: one tangent touches far away, the other nearer than the plane.
    const vec4 beside = boundsOf({{5, 0, 0}, 3, 1});
    CHECK(beside.x == Approx(4.0 / 3).epsilon(1e-6));            // x / depth of the tangent from (0, 0)
    CHECK(beside.z == Approx(5 + std::sqrt(8.0)).epsilon(1e-6));  // x + sqrt(r^2 - 1) at depth 1
}

TEST_CASE("projected ball: one that touches the near plane from behind is a point, one that does not reach it is nothing") {
    const vec4 touching = boundsOf({{2, 1, -1}, 2, 1});
    for (int side = 0; side < 4; ++side) // The code widens by what rounding may hide: sqrt(2 * 3e-7) of the radius, over the near plane.
        CHECK(touching[side] == doctest::Approx(side % 2 == 0 ? 2 : 1).epsilon(2e-3));
    const vec4 behind = projectedBounds(perspective(1), vec4(2, 1, 1, 1.999f));
    CHECK(behind.x > behind.z);
    CHECK_FALSE(shared::coversPixel(behind, vec2(8, 8)));
}

TEST_CASE("projected ball: one that touches the near plane from beyond keeps its tangents") {
    // Depths 1 to 9: the tangent's point of touch, at depth (5^2 - 4^2) / 5, lies beyond the plane.
    const vec4 bounds = boundsOf({{0, 0, 5}, 4, 1});
    CHECK(bounds.z == Approx(4.0 / 3).epsilon(1e-6));
}

TEST_CASE("projected ball: an orthographic camera sees it in its own size") {
    View view{{.orthographic = true, .halfHeight = 2, .zNear = 0, .zFar = 10}, {2, 1}};
    const vec4 bounds = projectedBounds(render::viewConstants(view, {}), vec4(1, 0.5f, -3, 0.5f));
    CHECK(bounds.x == Approx(0.5 / 4));
    CHECK(bounds.z == Approx(1.5 / 4));
    CHECK(bounds.y == Approx(-1.0 / 2));
    CHECK(bounds.w == Approx(0));
}

TEST_CASE("projected ball: every point that is not nearer than the near plane projects into the bounds") {
    Random random;
    int points = 0;
    for (int i = 0; i < 5000; ++i) {
        const Ball ball = randomBall(random);
        const vec4 bounds = boundsOf(ball);
        const double radius = ball.radius - kRounding * (glm::length(ball.center) + ball.radius);
        for (int k = 0; k < 20; ++k) {
            const dvec3 p = ball.center + random.direction() * radius;
            if (p.z < ball.zNear) continue;
            ++points;
            const bool inside = p.x / p.z >= bounds.x && p.x / p.z <= bounds.z && p.y / p.z >= bounds.y && p.y / p.z <= bounds.w;
            if (!inside) FAIL("ball ", ball.center.x, " ", ball.center.y, " ", ball.center.z, " radius ", ball.radius);
        }
    }
    CHECK(points > 20000);
}

TEST_CASE("projected ball: each bound lies between the extremes of a ball that is larger and one that is smaller by the rounding") {
    Random random;
    int met = 0;
    for (int i = 0; i < 5000; ++i) {
        const Ball ball = randomBall(random);
        const vec4 bounds = boundsOf(ball);
        const double rounding = kRounding * (glm::length(ball.center) + ball.radius);
        if (ball.radius <= rounding || ball.center.z + ball.radius - rounding < ball.zNear) continue;  // hardly anything is left of it
        for (int axis = 0; axis < 2; ++axis)
            for (const double side : {-1.0, 1.0}) {
                ++met;
                const auto extreme = [&](double radius) {
                    return side * extremeSlope(ball.center[axis], ball.center.z, radius, ball.zNear, side);
                };
                const double bound = side * double(bounds[axis + (side > 0 ? 2 : 0)]);
                const double inner = extreme(ball.radius - rounding), outer = extreme(ball.radius + rounding);
                // The quotient itself is rounded.
                if (bound < inner - 2e-7 * std::abs(inner) || bound > outer + 2e-7 * std::abs(outer))
                    FAIL("ball ", ball.center.x, " ", ball.center.y, " ", ball.center.z, " radius ", ball.radius, " near ", ball.zNear,
                         ": expected ", inner, " to ", outer, ", got ", bound);
            }
    }
    CHECK(met > 15000);
}

TEST_CASE("bounds cover a pixel exactly if they hold the centre of one") {
    Random random;
    int covered = 0;
    for (int i = 0; i < 20000; ++i) {
        const uvec2 extent(1 + random.bits() % 9, 1 + random.bits() % 9);
        vec4 bounds;
        for (int axis = 0; axis < 2; ++axis) {
            const double middle = random.between(-1.3, 1.3), half = random.between(-0.02, 0.2);
            bounds[axis] = float(middle - half);
            bounds[axis + 2] = float(middle + half);
        }
        bool expected = false;
        for (uint32_t y = 0; y < extent.y; ++y)
            for (uint32_t x = 0; x < extent.x; ++x) {
                const dvec2 center = 2.0 * (dvec2(x, y) + 0.5) / dvec2(extent) - 1.0;
                expected |= center.x >= bounds.x && center.x <= bounds.z && center.y >= bounds.y && center.y <= bounds.w;
            }
        covered += expected;
        if (shared::coversPixel(bounds, vec2(extent)) != expected)
            FAIL(bounds.x, " ", bounds.y, " ", bounds.z, " ", bounds.w, " in ", extent.x, " x ", extent.y, ": expected ", expected);
    }
    CHECK(covered > 2000);
    CHECK(covered < 18000);
    CHECK(shared::coversPixel(vec4(-0.75f, -0.75f, -0.75f, -0.75f), vec2(4)));  // the very centre of pixel (0, 0)
    CHECK(shared::coversPixel(vec4(-3e38f, -3e38f, 3e38f, 3e38f), vec2(16384)));
}

TEST_CASE("bounding ball: holds every point of the sector") {
    Random random;
    for (const double angle : kAngles)
        for (int i = 0; i < 200; ++i) {
            const LightShape shape = randomShape(random, angle, 3);
            const dvec4 ball(boundingBall(shape));
            for (int k = 0; k < 50; ++k) {
                const double excess = glm::distance(pointOf(random, shape), dvec3(ball)) - ball.w;
                if (excess > kRounding * reach(shape)) FAIL("angle ", angle, " radius ", shape.radius, ": ", excess, " outside");
            }
        }
}

TEST_CASE("bounding ball: is the smallest, for the sector touches it on all sides of its centre") {
    // A ball is the smallest around a body if and only if its centre is in the convex hull of the points where they touch.
    Random random;
    for (const double angle : kAngles) {
        const LightShape shape = randomShape(random, angle, 0);
        const dvec3 axis = glm::normalize(dvec3(shape.axis));
        const dvec4 ball(boundingBall(shape));
        const double along = glm::dot(dvec3(ball), axis), r = shape.radius;
        CHECK(glm::distance(dvec3(ball), along * axis) <= kRounding * r);  // on the axis
        // The circle of the sector's surface that touches, by its angle: the rim, but the equator of more than a half ball.
        const double circle = std::min(angle, kPi / 2);
        const double height = r * std::cos(circle) - along;
        CHECK(std::hypot(r * std::sin(circle), height) == Approx(ball.w).epsilon(kRounding));
        // Either the centre is the circle's, or the apex, on the other side of it, touches too.
        const bool apexTouches = std::abs(along - ball.w) <= kRounding * r && along > 0;
        CHECK((std::abs(height) <= kRounding * r || (apexTouches && height > 0)));
    }
}

TEST_CASE("inflated shape: its hull holds every point that lies within the slack of a point of the shape") {
    Random random;
    for (const double angle : kAngles)
        for (int i = 0; i < 200; ++i) {
            const LightShape shape = randomShape(random, angle, 3);
            const double slack = shape.radius * random.logBetween(1e-5, 3);
            const LightShape larger = inflate(shape, float(slack));
            const double rounding = kRounding * (reach(larger) + reach(shape));
            for (int k = 0; k < 50; ++k) {
                const dvec3 p = pointOf(random, shape) + random.direction() * slack - dvec3(larger.apex);
                const dvec3 axis = glm::normalize(dvec3(larger.axis));
                const double outward = glm::distance(p, axis * glm::dot(p, axis)), along = glm::dot(p, axis);
                // Outside the ball; outside the cone, or below the plane through the rim of more than a half ball.
                const double a = larger.angle;
                const double side = a < kPi / 2 ? outward * std::cos(a) - along * std::sin(a) : larger.radius * std::cos(a) - along;
                if (glm::length(p) - larger.radius > rounding || side > rounding)
                    FAIL("angle ", angle, " radius ", shape.radius, " slack ", slack, ": ", glm::length(p) - larger.radius, ", ", side);
            }
        }
}

TEST_CASE("volume meshes: have as many indices as is said, one level after the other") {
    uint32_t end = 0;
    for (uint32_t lod = 0; lod <= shared::kVolumeScreen; ++lod) {
        CHECK(shared::volumeFirstIndex(lod) == end);
        end += shared::volumeIndexCount(lod);
    }
    CHECK(render::volumeIndices().size() == end);
}

TEST_CASE("volume meshes: are closed, each edge run through once in each direction") {
    for (uint32_t lod = 0; lod < shared::kVolumeLods; ++lod) {
        const Polyhedron mesh = meshOf({vec3(0), vec3(0, 0, 1), 1, 1}, lod);
        std::map<std::pair<uint32_t, uint32_t>, int> edges;
        for (size_t i = 0; i < mesh.indices.size(); ++i)
            ++edges[{mesh.indices[i], mesh.indices[i % 3 == 2 ? i - 2 : i + 1]}];
        for (const auto& [edge, count] : edges) {
            CHECK(count == 1);
            CHECK(edges.contains({edge.second, edge.first}));
        }
        CHECK(mesh.vertices.size() - edges.size() / 2 + mesh.indices.size() / 3 == 2);  // Euler: one ball
    }
}

TEST_CASE("volume meshes: all faces look outwards and leave the whole shape on their inner side") {
    Random random;
    for (const double angle : kAngles)
        for (uint32_t lod = 0; lod < shared::kVolumeLods; ++lod)
            for (int i = 0; i < 50; ++i) {
                const LightShape shape = randomShape(random, angle, 0);
                const auto planes = planesOf(meshOf(shape, lod), shape);
                // All faces but, of a ball, those at its pole: the base and one triangle of each quad of the last ring.
                if (angle < 3.11) CHECK(planes.size() >= shared::volumeIndexCount(lod) / 3 - (angle > 3 ? 2 * shared::volumeSlices(lod) : 0));
                for (const Plane& plane : planes) {
                    const double outside = support(shape, plane.normal) - plane.distance;
                    // Roundoff of the vertices, which turns narrow triangles, is less than what each shape is enlarged by.
                    if (outside > 4 * kRounding * shape.radius) FAIL("angle ", angle, " level ", lod, ": ", outside / shape.radius, " radii outside");
                }
            }
}

TEST_CASE("volume meshes: are convex, no vertex outside the plane of any face") {
    Random random;
    for (const double angle : kAngles)
        for (uint32_t lod = 0; lod < shared::kVolumeLods; ++lod) {
            const LightShape shape = randomShape(random, angle, 0);
            const Polyhedron mesh = meshOf(shape, lod);
            double outside = 0;
            for (const Plane& plane : planesOf(mesh, shape))
                for (const dvec3& vertex : mesh.vertices)
                    outside = std::max(outside, glm::dot(vertex - dvec3(shape.apex), plane.normal) - plane.distance);
            CHECK_MESSAGE(outside <= 8 * kRounding * shape.radius, "angle ", angle, " level ", lod);
        }
}

TEST_CASE("volume meshes: are no larger than they need be, a facet touches the ball and the pyramid the cone") {
    Random random;
    for (uint32_t lod = 1; lod < shared::kVolumeLods; ++lod)
        for (const double angle : kAngles) {
            const LightShape shape = randomShape(random, angle, 0);
            double ball = 1e30, cone = 1e30;
            for (const Plane& plane : planesOf(meshOf(shape, lod), shape)) {
                const double distance = plane.distance / shape.radius;
                const double off = std::acos(std::clamp(glm::dot(plane.normal, glm::normalize(dvec3(shape.axis))), -1.0, 1.0));
                if (angle > kPi / 2 && off > 3.1) continue;  // the base
                // A face of the pyramid goes through the apex; the cone's surface is `angle` off the axis.
                if (angle < kPi / 2 && std::abs(distance) < 1e-4)
                    cone = std::min(cone, off - (angle + kPi / 2));
                else
                    ball = std::min(ball, distance - 1);
            }
            CAPTURE(angle);
            CAPTURE(lod);
            // The radius is 1e-5 more than the closed form. (A facet of a narrow sector touches beside the sector.)
            if (angle > kPi / 2) CHECK(ball == Approx(1e-5).epsilon(0.2));
            // A narrow triangle's normal is uncertain by the roundoff of its vertices divided by its width.
            if (angle < kPi / 2) CHECK(std::abs(cone) < 1e-6 + 1e-6 / angle);
        }
}

TEST_CASE("volume meshes: the ball around a mesh holds its vertices") {
    Random random;
    for (const double angle : kAngles)
        for (uint32_t lod = 0; lod < shared::kVolumeLods; ++lod)
            for (int i = 0; i < 50; ++i) {
                const LightShape shape = randomShape(random, angle, 3);
                const dvec4 ball(meshBall(shape, lod));
                for (const dvec3& vertex : meshOf(shape, lod).vertices)
                    if (glm::distance(vertex, dvec3(ball)) - ball.w > kRounding * reach(shape)) FAIL("angle ", angle, " level ", lod);
            }
}

TEST_CASE("volume meshes: a ball's cover as much more than the ball as docs/techniques/light-volumes.md says") {
    const std::array documented{1.910, 1.636, 1.182, 1.083, 1.049};
    for (uint32_t lod = 0; lod < shared::kVolumeLods; ++lod) {
        const Polyhedron mesh = meshOf({vec3(0), vec3(0, 0, 1), 1, shared::kHalfTurn}, lod);
        CHECK(meanProjectedArea(mesh) / kPi == Approx(documented[lod]).epsilon(0.0005 / documented[lod]));  // three decimals
    }
}

TEST_CASE("volume draw: a light that reaches a surface at a pixel's centre is never left out") {
    Random random;
    for (const bool orthographic : {false, true}) {
        int reached = 0, left = 0;
        for (int i = 0; i < 20000; ++i) {
            const View view = randomView(random, orthographic);
            ViewConstants constants = render::viewConstants(view, {});
            constants.slack = render::viewSlack(view, GBufferLayout::compact);
            const double angle = random.between(0, 1) < 0.5 ? kPi : random.between(0.01, kPi);
            LightShape shape = randomShape(random, angle, 1);
            // Beside and around the eye, or as small as a few pixels.
            const double distance = random.between(0, 1) < 0.3 ? 1 + random.between(-0.01, 0.01) : random.logBetween(0.1, 30);
            shape.apex = vec3(random.direction() * double(shape.radius) * distance);
            const bool visible = shared::volumeDraw(constants, lightOf(shape)).visible;
            const bool expected = seen(view, shape);
            reached += expected;
            left += !visible;
            if (expected && !visible)
                FAIL("apex ", shape.apex.x, " ", shape.apex.y, " ", shape.apex.z, " radius ", shape.radius, " angle ", angle, " near ", view.camera.zNear);
        }
        CHECK(reached > 1000);
        CHECK(left > 1000);
    }
}

TEST_CASE("volume draw: where it is told to leave out nothing, it draws what is behind the eye as well") {
    ViewConstants view = perspective(0.1f, {64, 64});
    const LightConstants behind = lightOf({vec3(0, 0, 10), vec3(0, 0, 1), 1, shared::kHalfTurn});
    CHECK_FALSE(shared::volumeDraw(view, behind).visible);
    view.cullLights = 0;
    CHECK(shared::volumeDraw(view, behind).visible);
}

TEST_CASE("volume draw: front faces are drawn only of meshes that lie beyond the near plane as a whole") {
    Random random;
    int front = 0, back = 0;
    for (int i = 0; i < 20000; ++i) {
        const View view = randomView(random, false);
        ViewConstants constants = render::viewConstants(view, {});
        constants.slack = render::viewSlack(view, GBufferLayout::compact);
        const LightShape plain = randomShape(random, random.between(0, 1) < 0.5 ? kPi : random.between(0.01, kPi), 4);
        const LightConstants light = lightOf(plain);
        const shared::VolumeDraw draw = shared::volumeDraw(constants, light);
        ++(draw.frontFaces ? front : back);
        if (!draw.frontFaces) continue;
        const LightShape shape = inflate(shared::lightShape(light), slackOf(constants, shared::lightShape(light)));
        for (const dvec3& vertex : meshOf(shape, draw.lod).vertices)
            if (-vertex.z < view.camera.zNear - kRounding * reach(shape)) FAIL("depth ", -vertex.z, ", near ", view.camera.zNear);
    }
    CHECK(front > 1000);
    CHECK(back > 1000);
}
