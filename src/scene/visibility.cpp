#include "scene/visibility.hpp"

#if LUCIOLE_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <tuple>

namespace luciole {
namespace {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

using DeviceHandle = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using SceneHandle = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;
using GeometryHandle = std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)>;

/// One thread builds: trees, and with them the choice between triangles that share an edge, are the same every time.
constexpr const char* kDeviceConfig = "threads=1,set_affinity=0";

SceneHandle newScene(RTCDevice device) {
    SceneHandle scene(rtcNewScene(device), &rtcReleaseScene);
    if (!scene) throw std::bad_alloc();
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

/// Moves barycentrics that single precision let slip outside onto the triangle. What is left out is a rounding error.
void clampToTriangle(double& u, double& v) {
    u = std::max(u, 0.0);
    v = std::max(v, 0.0);
    const double sum = std::max(u + v, 1.0);
    u /= sum;
    v /= sum;
}

}  // namespace

PlaneHit intersectPlane(dvec3 origin, dvec3 direction, const std::array<dvec3, 3>& triangle) {
    // Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", without the bounds.
    const dvec3 edge1 = triangle[1] - triangle[0];
    const dvec3 edge2 = triangle[2] - triangle[0];
    const dvec3 p = cross(direction, edge2);
    const double determinant = dot(edge1, p);
    const dvec3 s = origin - triangle[0];
    const dvec3 q = cross(s, edge1);
    return {.t = dot(edge2, q) / determinant,
            .u = dot(s, p) / determinant,
            .v = dot(direction, q) / determinant,
            .facing = -determinant};
}

struct Visibility::Impl {
    const Scene& scene;
    std::vector<dmat4> worldFromObject;
    std::vector<bool> mirrored;
    DeviceHandle device{rtcNewDevice(kDeviceConfig), &rtcReleaseDevice};
    std::vector<SceneHandle> meshes;  ///< parallel to Scene::meshes
    SceneHandle world{nullptr, &rtcReleaseScene};
    dvec3 low{0}, high{0};  ///< world-space bounds; low > high if nothing is there

    struct Query;

    explicit Impl(const Scene& s);
    static void filterHit(const RTCFilterFunctionNArguments* arguments);
    bool isThere(const Hit& hit, const Query& query) const;
    SceneHandle meshScene(const Mesh& mesh) const;
    void addInstance(uint32_t object);
    std::array<dvec3, 3> corners(uint32_t object, uint32_t triangle) const;
    std::optional<Hit> hitOf(uint32_t object, uint32_t triangle, dvec3 origin, dvec3 direction) const;
    bool adjoin(const Hit& a, const Hit& b, dvec3 direction) const;
    bool isEmpty() const { return low.x > high.x; }
    double startOf(dvec3 origin, dvec3 direction, double tMin) const;
    RTCRay rayOf(dvec3 origin, dvec3 direction, double tMin) const;
};

/// What one query carries through Embree, which hands back a pointer to the base.
struct Visibility::Impl::Query : QueryContext {
    const Impl* impl;
    const Accept* accept;
    dvec3 origin, direction;
    double tMin, tMax = HUGE_VAL;
    bool backFaces = false;  ///< of single-sided materials are hit, too
    std::optional<Hit> best;
};

void Visibility::Impl::filterHit(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *static_cast<Query*>(arguments->context);
    const uint32_t object = RTCHitN_instID(arguments->hit, arguments->N, 0, 0);
    const uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    const auto hit = query.impl->hitOf(object, triangle, query.origin, query.direction);
    if (!hit || !query.impl->isThere(*hit, query)) {
        arguments->valid[0] = 0;
    } else if (!query.best || hit->t < query.best->t) {
        query.best = hit;
    }
}

bool Visibility::Impl::isThere(const Hit& hit, const Query& query) const {
    if (hit.t < query.tMin || hit.t > query.tMax) return false;
    if (!hit.frontFace && !query.backFaces && !scene.materials[scene.objects[hit.object].material].doubleSided) return false;
    return !*query.accept || (*query.accept)(hit);
}

Visibility::Impl::Impl(const Scene& s) : scene(s), world(newScene(device.get())) {
    for (const Object& object : scene.objects) {
        worldFromObject.emplace_back(object.worldFromObject);
        mirrored.push_back(determinant(dmat3(worldFromObject.back())) < 0);
    }
    for (const Mesh& mesh : scene.meshes) meshes.push_back(meshScene(mesh));
    for (uint32_t i = 0; i < scene.objects.size(); ++i) addInstance(i);
    rtcCommitScene(world.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    RTCBounds bounds;
    rtcGetSceneBounds(world.get(), &bounds);
    low = dvec3(bounds.lower_x, bounds.lower_y, bounds.lower_z);
    high = dvec3(bounds.upper_x, bounds.upper_y, bounds.upper_z);
}

SceneHandle Visibility::Impl::meshScene(const Mesh& mesh) const {
    SceneHandle result = newScene(device.get());
    if (!mesh.indices.empty()) {
        const GeometryHandle geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
        // Embree reads 16 bytes per position; in a Vertex the normal follows.
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(),
                                   offsetof(Vertex, position), sizeof(Vertex), mesh.vertices.size());
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                                   3 * sizeof(uint32_t), mesh.indices.size() / 3);
        rtcSetGeometryIntersectFilterFunction(geometry.get(), filterHit);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), filterHit);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(result.get(), geometry.get());
    }
    rtcCommitScene(result.get());
    return result;
}

void Visibility::Impl::addInstance(uint32_t object) {
    const Object& source = scene.objects[object];
    if (scene.meshes[source.mesh].indices.empty()) return;
    if (!isDrawn(source)) return;
    const GeometryHandle instance(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE), &rtcReleaseGeometry);
    rtcSetGeometryInstancedScene(instance.get(), meshes[source.mesh].get());
    rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &source.worldFromObject[0][0]);
    rtcCommitGeometry(instance.get());
    rtcAttachGeometryByID(world.get(), instance.get(), object);
}

std::array<dvec3, 3> Visibility::Impl::corners(uint32_t object, uint32_t triangle) const {
    const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
    std::array<dvec3, 3> result;
    for (size_t i = 0; i < 3; ++i) {
        const Vertex& vertex = mesh.vertices[mesh.indices[3 * size_t(triangle) + i]];
        result[i] = dvec3(worldFromObject[object] * dvec4(dvec3(vertex.position), 1.0));
    }
    return result;
}

std::optional<Hit> Visibility::Impl::hitOf(uint32_t object, uint32_t triangle, dvec3 origin, dvec3 direction) const {
    const auto positions = corners(object, triangle);
    const PlaneHit plane = intersectPlane(origin, direction, positions);
    if (!std::isfinite(plane.t) || !std::isfinite(plane.u) || !std::isfinite(plane.v)) return std::nullopt;
    Hit hit{.object = object,
            .triangle = triangle,
            .t = plane.t,
            .u = plane.u,
            .v = plane.v,
            .frontFace = (plane.facing < 0) != mirrored[object]};
    clampToTriangle(hit.u, hit.v);
    if (hit.u != plane.u || hit.v != plane.v) {
        const dvec3 point =
            positions[0] + hit.u * (positions[1] - positions[0]) + hit.v * (positions[2] - positions[0]);
        hit.t = dot(point - origin, direction) / dot(direction, direction);
    }
    return hit;
}

/// Whether two hits of one ray are one: a ray through an edge or a vertex, or past it within the rounding of single
/// precision, hits all triangles that meet there. Fails for layers of one object that are nearer to each other than
/// that: in the outermost thousandth of their triangles they are taken for one.
bool Visibility::Impl::adjoin(const Hit& a, const Hit& b, dvec3 direction) const {
    if (a.object != b.object || a.frontFace != b.frontFace) return false;
    if (a.triangle == b.triangle) return true;  // Embree may report a triangle more than once
    const auto atBorder = [](const Hit& hit) { return std::min({hit.u, hit.v, 1 - hit.u - hit.v}) < 1e-3; };
    const double rounding = 1e-6 * length(max(abs(low), abs(high)));
    return atBorder(a) && atBorder(b) && std::abs(a.t - b.t) * length(direction) <= rounding;
}

/// Where Embree's ray starts: just before the scene, however far away the origin is, so that its single-precision
/// origin is as exact as the scene's own coordinates. The filter sees to the exact tMin.
double Visibility::Impl::startOf(dvec3 origin, dvec3 direction, double tMin) const {
    double entry = tMin;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) continue;
        const double near = direction[axis] > 0 ? low[axis] : high[axis];
        entry = std::max(entry, (near - origin[axis]) / direction[axis]);
    }
    const double slack = 1e-5 * (length(origin + entry * direction) + length(high - low));
    return entry - slack / length(direction);
}

RTCRay Visibility::Impl::rayOf(dvec3 origin, dvec3 direction, double tMin) const {
    const vec3 from = vec3(origin + startOf(origin, direction, tMin) * direction);
    const vec3 along = vec3(normalize(direction));
    return {.org_x = from.x,
            .org_y = from.y,
            .org_z = from.z,
            .tnear = 0,
            .dir_x = along.x,
            .dir_y = along.y,
            .dir_z = along.z,
            .time = 0,
            .tfar = INFINITY,
            .mask = ~0u,
            .id = 0,
            .flags = 0};
}

Visibility::Visibility(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;

std::optional<Hit> Visibility::closest(dvec3 origin, dvec3 direction, double tMin, const Accept& accept) const {
    if (impl_->isEmpty()) return std::nullopt;
    Impl::Query query{{}, impl_.get(), &accept, origin, direction, tMin};
    RTCRayHit ray{};
    ray.ray = impl_->rayOf(origin, direction, tMin);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &query;
    rtcIntersect1(impl_->world.get(), &ray, &arguments);
#else
    rtcInitIntersectContext(&query);
    rtcIntersect1(impl_->world.get(), &query, &ray);
#endif
    return query.best;
}

bool Visibility::isBlocked(dvec3 origin, dvec3 direction, double tMax, const Accept& accept) const {
    if (impl_->isEmpty()) return false;
    Impl::Query query{{}, impl_.get(), &accept, origin, direction, 0, tMax, true};
    RTCRay ray = impl_->rayOf(origin, direction, 0);
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &query;
    rtcOccluded1(impl_->world.get(), &ray, &arguments);
#else
    rtcInitIntersectContext(&query);
    rtcOccluded1(impl_->world.get(), &query, &ray);
#endif
    return query.best.has_value();
}

std::vector<Hit> Visibility::allBetween(dvec3 origin, dvec3 direction, double tMin, double tMax,
                                        const Accept& accept) const {
    std::vector<Hit> hits;
    const auto gather = [&](const Hit& hit) {
        const auto known = [&](const Hit& other) { return impl_->adjoin(hit, other, direction); };
        if (hit.t <= tMax && (!accept || accept(hit)) && std::ranges::none_of(hits, known)) hits.push_back(hit);
        return false;  // so that the ray goes on
    };
    closest(origin, direction, tMin, gather);
    std::ranges::sort(hits, [](const Hit& a, const Hit& b) {
        return std::tie(b.t, a.object, a.triangle) < std::tie(a.t, b.object, b.triangle);
    });
    return hits;
}

std::array<dvec3, 3> Visibility::triangleWorld(uint32_t object, uint32_t triangle) const {
    return impl_->corners(object, triangle);
}

std::string Visibility::engine() { return "Embree " RTC_VERSION_STRING; }

}  // namespace luciole
