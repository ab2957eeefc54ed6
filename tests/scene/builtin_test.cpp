#include "scene/builtin/builtin.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "hash.hpp"
#include "scene/builtin/hall.hpp"
#include "scene/visibility.hpp"
#include "support.hpp"

using namespace luciole;

namespace {

uint64_t hashOf(const Scene& scene) {
    Hash hash;
    for (const Mesh& mesh : scene.meshes) {
        for (const Vertex& v : mesh.vertices) {
            hash.add(v.position), hash.add(v.normal), hash.add(v.tangent), hash.add(v.uv0), hash.add(v.color);
        }
        for (const uint32_t index : mesh.indices) hash.add(index);
    }
    for (const Object& o : scene.objects) {
        hash.add(o.name), hash.add(o.mesh), hash.add(o.material), hash.add(o.worldFromObject), hash.add(o.objectId);
    }
    for (const Material& m : scene.materials) {
        hash.add(m.name), hash.add(m.baseColor), hash.add(m.roughness), hash.add(m.proceduralColor);
    }
    for (const Light& l : scene.lights) {
        hash.add(l.name), hash.add(l.positionWorld), hash.add(l.directionWorld), hash.add(l.color), hash.add(l.range);
    }
    for (const Camera& c : scene.cameras) hash.add(c.worldFromView);
    return hash.value();
}

struct Triangle {
    dvec3 a, b, c;
    bool doubleSided;
    bool glows;
};

std::vector<Triangle> trianglesOf(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        const Material& material = scene.materials[object.material];
        const dmat4 matrix(object.worldFromObject);
        const auto corner = [&](uint32_t i) {
            return dvec3(matrix * dvec4(mesh.vertices[mesh.indices[i]].position, 1));
        };
        for (uint32_t i = 0; i < mesh.indices.size(); i += 3)
            triangles.push_back(
                {corner(i), corner(i + 1), corner(i + 2), material.doubleSided, material.emissive != vec3(0)});
    }
    return triangles;
}

struct RayHit {
    double t = 1e30;
    bool front = true;
    bool found() const { return t < 1e30; }
};

/// Nearest triangle by looking at every one (Moeller and Trumbore 1997). \param use says which triangles count
template <class Use>
RayHit nearest(const std::vector<Triangle>& triangles, dvec3 origin, dvec3 direction, const Use& use) {
    RayHit hit;
    for (const Triangle& triangle : triangles) {
        const dvec3 e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a, p = glm::cross(direction, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0) continue;
        const dvec3 s = origin - triangle.a, q = glm::cross(s, e1);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double t = glm::dot(e2, q) / determinant;
        if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= hit.t || !use(triangle, determinant > 0)) continue;
        hit = {t, determinant > 0};
    }
    return hit;
}

/// Mean number of lights nearer than their range, and for spots within the cone, over the pixels of a small picture.
double measuredOverlap(const Scene& scene, int width, int height) {
    const std::vector<Triangle> triangles = trianglesOf(scene);
    const Camera& camera = scene.cameras.front();
    const dmat4 worldFromView(camera.worldFromView);
    const double top = std::tan(camera.yFov / 2);
    uint64_t reached = 0, visible = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const dvec3 eye(worldFromView[3]);
            const dvec3 direction(worldFromView * dvec4(top * width / height * (2 * (x + 0.5) / width - 1),
                                                        top * (1 - 2 * (y + 0.5) / height), -1, 0));
            const RayHit hit = nearest(triangles, eye, direction,
                                       [](const Triangle& t, bool front) { return front || t.doubleSided; });
            if (!hit.found()) continue;
            ++visible;
            const dvec3 point = eye + hit.t * direction;
            for (const Light& light : scene.lights) {
                const dvec3 away = point - dvec3(light.positionWorld);
                const double cosine = glm::dot(glm::normalize(away), dvec3(light.directionWorld));
                const bool inCone = light.type == LightType::point || cosine > std::cos(light.outerConeAngle);
                reached += glm::length(away) < light.range && inCone;
            }
        }
    return double(reached) / double(visible);
}

}  // namespace

TEST_CASE("builtin: the same URI makes the same scene, another seed another one") {
    for (const char* uri :
         {"builtin:hall?lights=40&triangles=5000", "builtin:materials", "builtin:fireflies?lights=50"})
        CHECK(hashOf(makeBuiltin(uri)) == hashOf(makeBuiltin(uri)));
    CHECK(hashOf(makeBuiltin("builtin:hall?lights=40&triangles=5000&seed=2")) !=
          hashOf(makeBuiltin("builtin:hall?lights=40&triangles=5000&seed=1")));
    CHECK(hashOf(makeBuiltin("builtin:fireflies?lights=50&seed=2")) !=
          hashOf(makeBuiltin("builtin:fireflies?lights=50")));
}

TEST_CASE("builtin: each scene of the table is valid with what it has by default, and has a camera") {
    for (const BuiltinScene& row : builtinScenes()) {
        CAPTURE(row.name);
        const Scene scene = makeBuiltin("builtin:" + std::string(row.name));
        CHECK_NOTHROW(validate(scene));
        CHECK(scene.name == row.name);
        CHECK(scene.cameras.size() == 1);
        CHECK(scene.warnings.empty());
    }
}

TEST_CASE("builtin: normals are on the front side of their triangles, tangents square to them") {
    for (const BuiltinScene& row : builtinScenes()) {
        const Scene scene = makeBuiltin("builtin:" + std::string(row.name));
        std::set<uint32_t> singleSided;
        for (const Object& object : scene.objects)
            if (!scene.materials[object.material].doubleSided) singleSided.insert(object.mesh);
        for (const uint32_t index : singleSided) {
            const Mesh& mesh = scene.meshes[index];
            int wrong = 0, tilted = 0;
            for (size_t i = 0; i < mesh.indices.size(); i += 3) {
                const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                             &c = mesh.vertices[mesh.indices[i + 2]];
                const vec3 face = glm::cross(b.position - a.position, c.position - a.position);
                wrong += glm::dot(face, a.normal + b.normal + c.normal) <= 0;
            }
            for (const Vertex& v : mesh.vertices) tilted += std::abs(glm::dot(v.normal, vec3(v.tangent))) > 1e-3f;
            CAPTURE(mesh.name);
            CHECK(wrong == 0);
            CHECK(tilted == 0);
        }
    }
}

TEST_CASE("builtin:hall: the number of triangles is met within 2 %, that of lights exactly") {
    for (const int triangles : {1000, 1357, 2500, 6000, 20'000, 40'000, 250'000})
        for (const int lights : {0, 17}) {
            const Scene scene = makeBuiltin("builtin:hall?triangles=" + std::to_string(triangles) +
                                            "&lights=" + std::to_string(lights));
            CHECK(double(triangleCount(scene)) == doctest::Approx(triangles).epsilon(0.02));
            CHECK(scene.lights.size() == size_t(lights));
        }
}

TEST_CASE("builtin:hall: the mean number of lights that reach a visible pixel is met within 3 %") {
    // 2 % that are promised, 1 % for the coarser picture measured here.
    struct Demand {
        const char* uri;
        double overlap;
    };
    for (const Demand demand : {Demand{"builtin:hall?lights=255&overlap=4&triangles=9000", 4},
                                Demand{"builtin:hall?lights=1024&overlap=16&triangles=9000", 16},
                                Demand{"builtin:hall?lights=300&overlap=0.5&triangles=5000&seed=9", 0.5}}) {
        const Scene scene = makeBuiltin(demand.uri);
        CAPTURE(demand.uri);
        CHECK(scene.warnings.empty());
        CHECK(measuredOverlap(scene, 120, 90) == doctest::Approx(demand.overlap).epsilon(0.03));
    }
}

TEST_CASE("builtin:hall: with gltf=1 the same hall has glTF's materials alone, each of one colour") {
    const std::string uri = "builtin:hall?lights=40&triangles=20000";
    const Scene shaped = makeBuiltin(uri), gltf = makeBuiltin(uri + "&gltf=1");
    CHECK_NOTHROW(validate(gltf));
    CHECK(gltf.functions.empty());
    for (const Material& material : gltf.materials) {
        CHECK(material.equation == LightEquation::metallicRoughness);
        CHECK(material.surface == SurfaceShader::textured);
    }
    CHECK(std::ranges::any_of(shaped.materials, [](const Material& material) { return material.equation == LightEquation::shaped; }));
    CHECK(triangleCount(gltf) == triangleCount(shaped));
    CHECK(gltf.objects.size() == shaped.objects.size());
    REQUIRE(gltf.lights.size() == shaped.lights.size());
    for (size_t i = 0; i < gltf.lights.size(); ++i) {
        CHECK(gltf.lights[i].positionWorld == shaped.lights[i].positionWorld);
        CHECK(gltf.lights[i].range == shaped.lights[i].range);
    }
}

TEST_CASE("builtin:hall: an overlap that can't be had gives a warning and the nearest") {
    const Scene scene = makeBuiltin("builtin:hall?lights=1&overlap=16&triangles=3000");
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].find("overlap") != std::string::npos);
    CHECK(measuredOverlap(scene, 20, 15) == doctest::Approx(1));
}

TEST_CASE("builtin:hall: no light is inside something solid") {
    const Scene scene = makeBuiltin("builtin:hall?lights=1400&triangles=25000");
    const std::vector<Triangle> triangles = trianglesOf(scene);
    // From outside, the first thing a ray meets shows its front; the lamps' own glowing bodies don't count.
    for (const Light& light : scene.lights)
        for (const dvec3 direction : {dvec3(0.31, 0.9, 0.21), dvec3(-0.83, 0.11, 0.4)}) {
            const RayHit hit =
                nearest(triangles, light.positionWorld, direction, [](const Triangle& t, bool) { return !t.glows; });
            CAPTURE(light.name);
            CHECK(hit.found());
            CHECK(hit.front);
        }
}

TEST_CASE("builtin: nothing that casts shadows encloses a lamp, or stands before the moon") {
    for (const char* uri : {"builtin:hall?lights=255", "builtin:fireflies?lights=100", "builtin:materials"}) {
        const Scene scene = makeBuiltin(uri);
        const Visibility visibility(scene);
        const auto casts = [&](const Hit& hit) { return scene.materials[scene.objects[hit.object].material].castsShadows; };
        for (const Light& light : scene.lights) {
            INFO(uri << ", " << light.name);
            if (light.type == LightType::directional) {
                const dvec3 lawn(0, 8, 2);  // above all that stands there
                CHECK_FALSE(visibility.isBlocked(lawn, -dvec3(light.directionWorld), HUGE_VAL, casts));
                continue;
            }
            int blocked = 0;  // a firefly may sit on a blade of grass
            for (const dvec3 axis : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)})
                for (const double side : {-1.0, 1.0}) blocked += visibility.isBlocked(light.positionWorld, side * axis, 1.5 * hall::kLampRadius, casts);
            CHECK(blocked <= 2);
        }
    }
}

TEST_CASE("builtin:materials shows every kind of dot-product function, from plastic to metal") {
    const Scene scene = makeBuiltin("builtin:materials");
    std::set<Function::Kind> kinds;
    std::set<float> blends;
    std::set<SurfaceShader> surfaces;
    for (const Object& object : scene.objects) {
        const Material& material = scene.materials[object.material];
        surfaces.insert(material.surface);
        if (material.equation != LightEquation::shaped) continue;
        kinds.insert(scene.functions[material.shaped.diffuseFunction].kind);
        kinds.insert(scene.functions[material.shaped.specularFunction].kind);
        blends.insert(material.shaped.specularBlend);
    }
    CHECK(kinds.size() == 7);
    CHECK(surfaces.size() == 3);
    CHECK(*blends.begin() == 0);
    CHECK(*blends.rbegin() == 1);
}

TEST_CASE("builtin:fireflies: the parameter counts the fireflies; moon and lantern shine without any") {
    const Scene none = makeBuiltin("builtin:fireflies?lights=0"), many = makeBuiltin("builtin:fireflies?lights=3000");
    CHECK(many.lights.size() - none.lights.size() == 3000);
    CHECK(none.lights.size() == 2);
    CHECK_NOTHROW(validate(many));
}

TEST_CASE("builtin: a bad URI is refused with the key, what was expected and what was found") {
    struct Bad {
        const char* uri;
        std::vector<const char*> says;
    };
    const std::vector<Bad> bads = {
        {"builtin:", {"hall, materials, fireflies"}},
        {"builtin:cellar", {"hall, materials, fireflies", "cellar"}},
        {"builtin:hall?lamps=3", {"lamps", "lights, overlap, triangles, seed, gltf"}},
        {"builtin:hall?lights", {"lights", "whole number from 0 to 1048576", "\"\""}},
        {"builtin:hall?lights=many", {"lights", "\"many\""}},
        {"builtin:hall?lights=1.5", {"lights", "whole number", "\"1.5\""}},
        {"builtin:hall?lights=-1", {"lights", "\"-1\""}},
        {"builtin:hall?lights=12x", {"lights", "\"12x\""}},
        {"builtin:hall?lights=1048577", {"lights", "1048576"}},
        {"builtin:hall?overlap=nan", {"overlap", "0.1 to 256", "\"nan\""}},
        {"builtin:hall?overlap=inf", {"overlap", "\"inf\""}},
        {"builtin:hall?triangles=999", {"triangles", "1000 to 4000000", "\"999\""}},
        {"builtin:hall?seed=4294967296", {"seed", "4294967295"}},
        {"builtin:hall?lights=1&lights=2", {"lights", "once"}},
        {"builtin:hall?&", {"one of"}},
        {"builtin:materials?lights=1", {"lights", "no parameters"}},
        {"file:hall", {"builtin:"}},
    };
    for (const Bad& bad : bads) {
        CAPTURE(bad.uri);
        try {
            makeBuiltin(bad.uri);
            FAIL("accepted");
        } catch (const Error& error) {
            const std::string message = error.what();
            CAPTURE(message);
            CHECK(error.kind() == ErrorKind::usage);
            CHECK(message.starts_with(bad.uri));
            for (const char* part : bad.says) CHECK(message.find(part) != std::string::npos);
        }
    }
}
