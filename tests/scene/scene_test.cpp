#include <cmath>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include <luciole/error.hpp>
#include <luciole/scene.hpp>

using namespace luciole;
using doctest::Approx;

namespace {

using Kind = Function::Kind;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void checkValue(const Function& function, double x, double shape, double cascade) {
    CAPTURE(x);
    const dvec2 value = evaluate(function, x);
    // A parameter is a float: 2^-24 relative, a little more after a power.
    CHECK(value.x == Approx(shape).epsilon(1e-6));
    CHECK(value.y == Approx(cascade).epsilon(1e-12));
}

/// One triangle (0,0,0) (2,0,0) (0,2,0).
Mesh triangle() {
    Mesh mesh{.name = "triangle", .vertices = std::vector<Vertex>(3), .indices = {0, 1, 2}};
    mesh.vertices[1].position = {2, 0, 0};
    mesh.vertices[2].position = {0, 2, 0};
    return mesh;
}

/// A tetrahedron, closed.
LightVolume tetrahedron() {
    return {.name = "shape",
            .positionsWorld = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            .indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

/// A valid scene with one of everything.
Scene completeScene() {
    Scene scene;
    scene.meshes = {triangle()};
    scene.objects = {{.name = "floor"}};
    scene.materials = {{.name = "stone", .equation = LightEquation::shaped}};
    scene.texels = {{.name = "dot", .width = 1, .height = 1, .rgba = {1, 2, 3, 4}}};
    scene.textures = {{}};
    scene.functions = {{.name = "f"}};
    scene.lights = {{.name = "lamp"}};
    scene.linkGroups = {{.name = "group"}};
    scene.lightVolumes = {tetrahedron()};
    scene.lights[0].volume = 0;
    scene.cameras = {{.name = "eye"}};
    return scene;
}

Scene sceneOfPoints(const std::vector<vec3>& points) {
    Scene scene;
    scene.meshes.emplace_back();
    for (const vec3& point : points) {
        scene.meshes[0].indices.push_back(uint32_t(scene.meshes[0].vertices.size()));
        scene.meshes[0].vertices.push_back({.position = point});
    }
    scene.objects.emplace_back();
    scene.materials.emplace_back();
    return scene;
}

}  // namespace

TEST_CASE("bounds: an empty scene has zero bounds") {
    const Bounds bounds = boundsOf(Scene{});
    CHECK(bounds.low == vec3(0));
    CHECK(bounds.high == vec3(0));
}

TEST_CASE("bounds: only what is drawn counts, at its place in the world") {
    Scene scene = completeScene();
    scene.meshes[0].vertices.push_back({.position = vec3(1000)});  // no index refers to it
    scene.objects[0].worldFromObject = mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1);
    const Bounds bounds = boundsOf(scene);
    CHECK(bounds.low == vec3(8, 20, 30));
    CHECK(bounds.high == vec3(10, 22, 30));
}

TEST_CASE("triangle count: every object counts its mesh") {
    Scene scene = completeScene();
    scene.objects.resize(5);
    CHECK(triangleCount(scene) == 5);
    CHECK(triangleCount(Scene{}) == 0);
}

TEST_CASE("functions: lambert, wrap, blinn-phong, constant and toon have their closed forms") {
    checkValue({.kind = Kind::lambert}, 0.25, 0.25, 1);
    checkValue({.kind = Kind::lambert}, 0, 0, 0);
    checkValue({.kind = Kind::lambert}, -0.5, 0, 0);

    checkValue({.kind = Kind::wrap, .parameter = 0.5f}, 1, 1, 1);
    checkValue({.kind = Kind::wrap, .parameter = 0.5f}, 0, 1.0 / 3, 1);
    checkValue({.kind = Kind::wrap, .parameter = 0.5f}, -0.25, 0.25 / 1.5, 1);
    checkValue({.kind = Kind::wrap, .parameter = 0.5f}, -0.5, 0, 0);
    checkValue({.kind = Kind::wrap, .parameter = 0}, -0.1, 0, 0);

    checkValue({.kind = Kind::blinnPhong, .parameter = 3}, 0.5, 0.125, 1);
    checkValue({.kind = Kind::blinnPhong, .parameter = 3}, -0.5, 0, 0);
    checkValue({.kind = Kind::blinnPhong, .parameter = 0}, 0.5, 1, 1);

    checkValue({.kind = Kind::constant, .parameter = 0.7f}, -1, 0.7, 0);
    checkValue({.kind = Kind::constant, .parameter = 0.7f}, 0.4, 0.7, 0.4);

    checkValue({.kind = Kind::toon, .parameter = 4}, 0.1, 0.25, 1);
    checkValue({.kind = Kind::toon, .parameter = 4}, 0.5, 0.5, 1);
    checkValue({.kind = Kind::toon, .parameter = 4}, 0.51, 0.75, 1);
    checkValue({.kind = Kind::toon, .parameter = 4}, 1, 1, 1);
    checkValue({.kind = Kind::toon, .parameter = 4}, 0, 0, 0);
}

TEST_CASE("functions: samples are evenly spread over the domain and linear in between") {
    const Function function{.kind = Kind::sampled, .samples = {{0, 1}, {1, 1}, {4, 0}}};
    CHECK(evaluate(function, -1) == dvec2(0, 1));
    CHECK(evaluate(function, -0.5) == dvec2(0.5, 1));
    CHECK(evaluate(function, 0) == dvec2(1, 1));
    CHECK(evaluate(function, 0.25) == dvec2(1.75, 0.75));
    CHECK(evaluate(function, 1) == dvec2(4, 0));
    CHECK(evaluate(function, 0, 0) == dvec2(0, 1));  // an attenuation: domain [0, 1]
    CHECK(evaluate(function, 0.5, 0) == dvec2(1, 1));
    CHECK(evaluate(function, 0.75, 0) == dvec2(2.5, 0.5));
}

TEST_CASE("functions: x beyond the domain, or no number, is clamped") {
    const Function function{.kind = Kind::sampled, .samples = {{2, 0}, {3, 0}}};
    CHECK(evaluate(function, -7).x == 2);
    CHECK(evaluate(function, 7).x == 3);
    CHECK(evaluate(function, -1, 0).x == 2);
    CHECK(evaluate(function, double(kNan)).x == 2);
}

TEST_CASE("functions: Oren-Nayar is the mean over all view directions of the model of 1994") {
    // Oren and Nayar 1994, eq. 30 without its last term: f = A + B max(0, cos dphi) sin alpha tan beta, times
    // cos(incidence); the mean over the hemisphere of views weighted by cos(view) / pi, by the midpoint rule.
    for (const double sigma : {0.0, 0.2, 0.5, 1.2}) {
        const Function function{.kind = Kind::orenNayar, .parameter = float(sigma)};
        const double s2 = double(function.parameter) * double(function.parameter);
        const double a = 1 - 0.5 * s2 / (s2 + 0.33);
        const double b = 0.45 * s2 / (s2 + 0.09);
        for (const double incidence : {0.05, 0.4, 0.8, 1.2, 1.5}) {
            constexpr int kSteps = 800;
            double mean = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double view = (i + 0.5) / kSteps * kPi / 2;
                const double alpha = std::max(view, incidence), beta = std::min(view, incidence);
                for (int j = 0; j < kSteps; ++j) {
                    const double phi = (j + 0.5) / kSteps * 2 * kPi;
                    const double f = a + b * std::max(0.0, std::cos(phi)) * std::sin(alpha) * std::tan(beta);
                    mean += f * std::cos(view) / kPi * std::sin(view);
                }
            }
            mean *= kPi / 2 / kSteps * 2 * kPi / kSteps * std::cos(incidence);
            CAPTURE(sigma);
            CAPTURE(incidence);
            // The midpoint rule's error with 800 steps: about 1e-6, at the kinks of max and min.
            CHECK(evaluate(function, std::cos(incidence)).x == Approx(mean).epsilon(1e-5));
        }
        CHECK(evaluate(function, 0) == dvec2(0));
        CHECK(evaluate(function, -0.3) == dvec2(0));
        CHECK(evaluate(function, 0.3).y == 1);
        CHECK(evaluate(function, 1).x == Approx(a).epsilon(1e-12));
    }
}

TEST_CASE("look at: the matrix is rigid and -Z goes through the target, also when the view is vertical") {
    const vec3 eye(1, 2, 3);
    const vec3 targets[] = {{4, 5, 6}, {1, 2, -7}, {1, -8, 3}, {1, 12, 3}, {1, 2, 3}};
    for (const vec3& target : targets) {
        CAPTURE(target.x);
        CAPTURE(target.y);
        const mat4 worldFromView = lookAt(eye, target);
        const glm::mat3 rotation(worldFromView);
        const glm::mat3 identity = glm::transpose(rotation) * rotation;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) CHECK(identity[i][j] == Approx(i == j ? 1 : 0).epsilon(1e-6));
        }
        CHECK(glm::determinant(rotation) == Approx(1).epsilon(1e-6));
        CHECK(vec3(worldFromView[3]) == eye);
        if (target != eye) {
            CHECK(glm::length(-rotation[2] - glm::normalize(target - eye)) < 1e-6f);
        }
    }
    // Upright: the camera's up leans towards +Y; straight down it is +Z.
    CHECK(lookAt(eye, targets[0])[1].y > 0.5f);
    CHECK(lookAt(eye, targets[2])[1] == vec4(0, 0, 1, 0));
}

TEST_CASE("auto camera: it sees the whole scene, whatever its size and place") {
    struct Case {
        const char* name;
        vec3 low, high;
    };
    const Case cases[] = {{"unit cube", {-1, -1, -1}, {1, 1, 1}},
                          {"planar", {-5, 0, -5}, {5, 0, 5}},
                          {"line", {0, 0, 0}, {0, 40, 0}},
                          {"tiny", {1e-9f, 0, 0}, {3e-9f, 2e-9f, 1e-9f}},
                          {"huge", {-1e15f, -1e14f, 0}, {1e15f, 1e15f, 1e15f}},
                          {"small and far away", {1e6f, 1e6f, 1e6f}, {1e6f + 1, 1e6f + 1, 1e6f + 1}},
                          {"point", {3, 4, 5}, {3, 4, 5}}};
    for (const Case& test : cases) {
        CAPTURE(test.name);
        Scene scene = sceneOfPoints({test.low, test.high, test.low});
        const Camera camera = autoCamera(scene);
        scene.cameras = {camera};
        CHECK_NOTHROW(validate(scene));
        const dmat4 viewFromWorld = glm::inverse(dmat4(camera.worldFromView));
        const double slope = std::tan(double(camera.yFov) / 2);
        for (int corner = 0; corner < 8; ++corner) {
            const dvec3 world(corner & 1 ? test.high.x : test.low.x, corner & 2 ? test.high.y : test.low.y,
                              corner & 4 ? test.high.z : test.low.z);
            const dvec3 view(viewFromWorld * dvec4(world, 1));
            CHECK(-view.z > double(camera.zNear));
            CHECK(std::abs(view.y) < -view.z * slope);
            CHECK(std::abs(view.x) < -view.z * slope);  // so a square picture shows it, too
        }
    }
    CHECK_NOTHROW(autoCamera(Scene{}));
}

TEST_CASE("auto camera: it stands in front, above the scene, and the scene fills the picture") {
    const Camera camera = autoCamera(sceneOfPoints({vec3(-1), vec3(1), vec3(-1)}));
    const vec3 eye(camera.worldFromView[3]);
    CHECK(eye.z > std::abs(eye.x));
    CHECK(eye.y > 0);
    // The bounding sphere has radius sqrt(3); its silhouette covers more than 4/5 of the picture's height.
    const double apparent = std::tan(std::asin(std::sqrt(3.0) / double(glm::length(eye))));
    CHECK(apparent / std::tan(double(camera.yFov) / 2) > 0.8);
}

TEST_CASE("validate: a scene with one of everything, and an empty one, are valid") {
    CHECK_NOTHROW(validate(completeScene()));
    CHECK_NOTHROW(validate(Scene{}));
}

TEST_CASE("validate: each broken rule is named with its element") {
    struct Rule {
        const char* expected;  ///< start of the message
        std::function<void(Scene&)> breakIt;
    };
    const auto spot = [](Scene& s, float inner, float outer) {
        s.lights[0].type = LightType::spot;
        s.lights[0].innerConeAngle = inner;
        s.lights[0].outerConeAngle = outer;
    };
    const auto function = [](Scene& s, Kind kind, float parameter) {
        s.functions[0] = {.name = "f", .kind = kind, .parameter = parameter};
    };
    const Rule rules[] = {
        {"meshes[0] \"triangle\": vertices[1].position", [](Scene& s) { s.meshes[0].vertices[1].position.y = kNan; }},
        {"meshes[0] \"triangle\": vertices[1].normal", [](Scene& s) { s.meshes[0].vertices[1].normal.z = 1.002f; }},
        {"meshes[0] \"triangle\": vertices[0].tangent", [](Scene& s) { s.meshes[0].vertices[0].tangent.x = 0.99f; }},
        {"meshes[0] \"triangle\": vertices[0].tangent.w", [](Scene& s) { s.meshes[0].vertices[0].tangent.w = 0; }},
        {"meshes[0] \"triangle\": vertices[2].uv0", [](Scene& s) { s.meshes[0].vertices[2].uv0.x = kInfinity; }},
        {"meshes[0] \"triangle\": vertices[2].uv1", [](Scene& s) { s.meshes[0].vertices[2].uv1.y = kNan; }},
        {"meshes[0] \"triangle\": vertices[2].color", [](Scene& s) { s.meshes[0].vertices[2].color.a = kNan; }},
        {"meshes[0] \"triangle\": indices: expected a multiple of 3, got 4",
         [](Scene& s) { s.meshes[0].indices.push_back(0); }},
        {"meshes[0] \"triangle\": indices[2]: expected an index below 3, got 3",
         [](Scene& s) { s.meshes[0].indices[2] = 3; }},
        {"objects[0] \"floor\": mesh: expected an index below 1, got 1", [](Scene& s) { s.objects[0].mesh = 1; }},
        {"objects[0] \"floor\": material: expected an index below 0, got 0", [](Scene& s) { s.materials.clear(); }},
        {"objects[0] \"floor\": worldFromObject", [](Scene& s) { s.objects[0].worldFromObject[3].x = kInfinity; }},
        {"texels[0] \"dot\": rgba", [](Scene& s) { s.texels[0].rgba.pop_back(); }},
        {"texels[0] \"dot\": rgba", [](Scene& s) { s.texels[0] = {.name = "dot"}; }},
        {"textures[0]: texels: expected an index below 1, got 4", [](Scene& s) { s.textures[0].texels = 4; }},
        {"functions[0] \"f\": parameter: expected [0, 1], got -0.5", [&](Scene& s) { function(s, Kind::wrap, -0.5f); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::wrap, 1.5f); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::orenNayar, -1); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::blinnPhong, kInfinity); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::constant, kNan); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::toon, 0); }},
        {"functions[0] \"f\": parameter", [&](Scene& s) { function(s, Kind::toon, 2.5f); }},
        {"functions[0] \"f\": samples: expected at least 2, got 1",
         [&](Scene& s) {
             function(s, Kind::sampled, 0);
             s.functions[0].samples = {vec2(1)};
         }},
        {"functions[0] \"f\": samples",
         [&](Scene& s) {
             function(s, Kind::sampled, 0);
             s.functions[0].samples = {vec2(1), vec2(1, kNan)};
         }},
        {"materials[0] \"stone\": baseColor:", [](Scene& s) { s.materials[0].baseColor.g = kNan; }},
        {"materials[0] \"stone\": metallic:", [](Scene& s) { s.materials[0].metallic = kNan; }},
        {"materials[0] \"stone\": roughness:", [](Scene& s) { s.materials[0].roughness = kNan; }},
        {"materials[0] \"stone\": emissive:", [](Scene& s) { s.materials[0].emissive.b = kInfinity; }},
        {"materials[0] \"stone\": alphaCutoff", [](Scene& s) { s.materials[0].alphaCutoff = kNan; }},
        {"materials[0] \"stone\": normalScale", [](Scene& s) { s.materials[0].normalScale = kNan; }},
        {"materials[0] \"stone\": occlusionStrength", [](Scene& s) { s.materials[0].occlusionStrength = kNan; }},
        {"materials[0] \"stone\": baseColorTexture: expected an index below 1, got 1",
         [](Scene& s) { s.materials[0].baseColorTexture.texture = 1; }},
        {"materials[0] \"stone\": metallicRoughnessTexture:",
         [](Scene& s) { s.materials[0].metallicRoughnessTexture.texture = 1; }},
        {"materials[0] \"stone\": normalTexture.uvSet: expected 0 or 1, got 2",
         [](Scene& s) { s.materials[0].normalTexture.uvSet = 2; }},
        {"materials[0] \"stone\": occlusionTexture.uvTransform",
         [](Scene& s) { s.materials[0].occlusionTexture.uvTransform[1].z = kNan; }},
        {"materials[0] \"stone\": emissiveTexture:", [](Scene& s) { s.materials[0].emissiveTexture.texture = 9; }},
        {"materials[0] \"stone\": shaped.diffuseFunction", [](Scene& s) { s.materials[0].shaped.diffuseFunction = 1; }},
        {"materials[0] \"stone\": shaped.specularFunction",
         [](Scene& s) { s.materials[0].shaped.specularFunction = kNone; }},
        {"materials[0] \"stone\": shaped.specularColor",
         [](Scene& s) { s.materials[0].shaped.specularColor.r = kNan; }},
        {"materials[0] \"stone\": shaped.kd", [](Scene& s) { s.materials[0].shaped.kd = -1; }},
        {"materials[0] \"stone\": shaped.ks", [](Scene& s) { s.materials[0].shaped.ks = kInfinity; }},
        {"materials[0] \"stone\": shaped.specularBlend: expected [0, 1], got 1.5",
         [](Scene& s) { s.materials[0].shaped.specularBlend = 1.5f; }},
        {"materials[0] \"stone\": shaped.kAmbient", [](Scene& s) { s.materials[0].shaped.kAmbient.g = -0.1f; }},
        {"materials[0] \"stone\": shaped.kEmissive", [](Scene& s) { s.materials[0].shaped.kEmissive = -1; }},
        {"materials[0] \"stone\": proceduralScale: expected a finite number > 0, got 0",
         [](Scene& s) {
             s.materials[0].surface = SurfaceShader::marble;
             s.materials[0].proceduralScale = 0;
         }},
        {"materials[0] \"stone\": proceduralColor",
         [](Scene& s) {
             s.materials[0].surface = SurfaceShader::checker;
             s.materials[0].proceduralColor.r = kNan;
         }},
        {"lights[0] \"lamp\": positionWorld", [](Scene& s) { s.lights[0].positionWorld.x = kNan; }},
        {"lights[0] \"lamp\": directionWorld: expected unit length",
         [](Scene& s) {
             s.lights[0].type = LightType::directional;
             s.lights[0].directionWorld = vec3(0);
         }},
        {"lights[0] \"lamp\": color: expected finite numbers >= 0, got (1, -1, 1)",
         [](Scene& s) { s.lights[0].color.g = -1; }},
        {"lights[0] \"lamp\": color", [](Scene& s) { s.lights[0].color.g = kInfinity; }},
        {"lights[0] \"lamp\": range: expected > 0, got -1", [](Scene& s) { s.lights[0].range = -1; }},
        {"lights[0] \"lamp\": range", [](Scene& s) { s.lights[0].range = kNan; }},
        {"lights[0] \"lamp\": innerConeAngle", [&](Scene& s) { spot(s, -0.1f, 0.5f); }},
        {"lights[0] \"lamp\": innerConeAngle", [&](Scene& s) { spot(s, 0.5f, 0.5f); }},
        {"lights[0] \"lamp\": outerConeAngle", [&](Scene& s) { spot(s, 0, 3.2f); }},
        {"lights[0] \"lamp\": outerConeAngle", [&](Scene& s) { spot(s, 0, 0); }},
        {"lights[0] \"lamp\": attenuation: expected an index below 1, got 1",
         [](Scene& s) { s.lights[0].attenuation = 1; }},
        {"lights[0] \"lamp\": attenuation: expected a function that is 0 at 1, the range's end (such as linear or smooth), got 1",
         [](Scene& s) { s.lights[0].attenuation = 0; s.lights[0].range = 2; }},
        {"lights[0] \"lamp\": range: expected finite, as the light has an attenuation function, got inf",
         [](Scene& s) { s.lights[0].attenuation = 0; }},
        {"lights[0] \"lamp\": falloff", [](Scene& s) { s.lights[0].falloff = 1; }},
        {"lights[0] \"lamp\": shadowSoftness: expected [0, 4], got 4.5", [](Scene& s) { s.lights[0].shadowSoftness = 4.5f; }},
        {"lights[0] \"lamp\": shadowSoftness", [](Scene& s) { s.lights[0].shadowSoftness = kNan; }},
        {"lights[0] \"lamp\": shadowResolution: expected [0.0625, 16], got 0.05", [](Scene& s) { s.lights[0].shadowResolution = 0.05f; }},
        {"lights[0] \"lamp\": linkGroup", [](Scene& s) { s.lights[0].linkGroup = 1; }},
        {"lights[0] \"lamp\": volume: expected an index below 1, got 1", [](Scene& s) { s.lights[0].volume = 1; }},
        {"lightVolumes[0] \"shape\": indices: expected a multiple of 3, at least one triangle, got 0",
         [](Scene& s) { s.lightVolumes[0].indices.clear(); }},
        {"lightVolumes[0] \"shape\": indices: expected a multiple of 3, at least one triangle, got 11",
         [](Scene& s) { s.lightVolumes[0].indices.pop_back(); }},
        {"lightVolumes[0] \"shape\": indices[4]: expected an index below 4, got 4",
         [](Scene& s) { s.lightVolumes[0].indices[4] = 4; }},
        {"lightVolumes[0] \"shape\": positionsWorld[2]: expected finite numbers, got (0, inf, 0)",
         [](Scene& s) { s.lightVolumes[0].positionsWorld[2].y = kInfinity; }},
        {"lightVolumes[0] \"shape\": positionsWorld[3]: expected finite numbers",
         [](Scene& s) { s.lightVolumes[0].positionsWorld[3].x = kNan; }},
        {"lightVolumes[0] \"shape\": indices: expected a closed surface, triangles turned alike (each edge run through as "
         "often one way as the other), got 3 open edges, one of them from (1, 0, 0) to (0, 1, 0)",
         [](Scene& s) { s.lightVolumes[0].indices.resize(9); }},
        {"lightVolumes[0] \"shape\": indices: expected a closed surface",  // one triangle turned over
         [](Scene& s) { std::swap(s.lightVolumes[0].indices[0], s.lightVolumes[0].indices[1]); }},
        {"lightVolumes[0] \"shape\": indices: expected a closed surface",  // one triangle twice
         [](Scene& s) { s.lightVolumes[0].indices.insert(s.lightVolumes[0].indices.end(), {0, 2, 1}); }},
        {"cameras[0] \"eye\": worldFromView", [](Scene& s) { s.cameras[0].worldFromView[0].x = 2; }},
        {"cameras[0] \"eye\": worldFromView", [](Scene& s) { s.cameras[0].worldFromView[0].x = -1; }},
        {"cameras[0] \"eye\": worldFromView", [](Scene& s) { s.cameras[0].worldFromView[0].y = 0.1f; }},
        {"cameras[0] \"eye\": worldFromView", [](Scene& s) { s.cameras[0].worldFromView[2].w = -1; }},
        {"cameras[0] \"eye\": worldFromView", [](Scene& s) { s.cameras[0].worldFromView[3].x = kNan; }},
        {"cameras[0] \"eye\": yFov", [](Scene& s) { s.cameras[0].yFov = 0; }},
        {"cameras[0] \"eye\": yFov", [](Scene& s) { s.cameras[0].yFov = 3.15f; }},
        {"cameras[0] \"eye\": zNear", [](Scene& s) { s.cameras[0].zNear = 0; }},
        {"cameras[0] \"eye\": halfHeight",
         [](Scene& s) {
             s.cameras[0].orthographic = true;
             s.cameras[0].halfHeight = 0;
         }},
        {"cameras[0] \"eye\": zNear",
         [](Scene& s) {
             s.cameras[0].orthographic = true;
             s.cameras[0].zNear = -1;
         }},
        {"cameras[0] \"eye\": zFar",
         [](Scene& s) {
             s.cameras[0].orthographic = true;
             s.cameras[0].zFar = 0.1f;
         }},
        {"ambience: sky", [](Scene& s) { s.ambience.sky.r = kNan; }},
        {"ambience: ground", [](Scene& s) { s.ambience.ground.r = kNan; }},
        {"ambience: upWorld", [](Scene& s) { s.ambience.upWorld = vec3(0); }},
        {"scene: exposureEv", [](Scene& s) { s.exposureEv = kInfinity; }},
    };
    for (const Rule& rule : rules) {
        CAPTURE(rule.expected);
        Scene scene = completeScene();
        rule.breakIt(scene);
        try {
            validate(scene);
            FAIL_CHECK("accepted");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::scene);
            CHECK(std::string(error.what()).starts_with(rule.expected));
        }
    }
}

TEST_CASE("validate: what a light, material or camera does not use is not held against it") {
    const std::function<void(Scene&)> changes[] = {
        [](Scene& s) { s.lights[0].directionWorld = vec3(0); },  // point lights have no direction
        [](Scene& s) { s.lights[0].outerConeAngle = -1; },       // nor a cone
        [](Scene& s) {
            s.lights[0].type = LightType::directional;  // no position, no distance
            s.lights[0].positionWorld = vec3(kNan);
            s.lights[0].attenuation = 0;
        },
        [](Scene& s) { s.materials[0].proceduralScale = 0; },  // a textured surface
        [](Scene& s) {
            s.materials[0].equation = LightEquation::metallicRoughness;
            s.materials[0].shaped.diffuseFunction = 7;
        },
        [](Scene& s) { s.cameras[0].halfHeight = 0; },  // a perspective camera
        [](Scene& s) {
            s.cameras[0].orthographic = true;
            s.cameras[0].yFov = 0;
            s.cameras[0].zNear = 0;
        },
        [](Scene& s) { s.meshes[0].vertices[0].normal.z = 1.0009f; },  // within the tolerance of 1e-3
    };
    for (const auto& change : changes) {
        Scene scene = completeScene();
        change(scene);
        CHECK_NOTHROW(validate(scene));
    }
}

TEST_CASE("validate: a light volume's vertices at equal positions are one, and triangles without area do not count") {
    Scene scene = completeScene();
    LightVolume& volume = scene.lightVolumes[0];
    const LightVolume shared = tetrahedron();
    volume.positionsWorld.clear();
    volume.indices.clear();
    for (const uint32_t index : shared.indices) {
        volume.indices.push_back(uint32_t(volume.positionsWorld.size()));
        volume.positionsWorld.push_back(index == 0 ? vec3(0, -0.0f, 0) : shared.positionsWorld[index]);
    }
    CHECK_NOTHROW(validate(scene));
    volume.indices.insert(volume.indices.end(), {0, 3, 1});  // 0 and 3 are one
    CHECK_NOTHROW(validate(scene));
    volume.positionsWorld[3].x = 1e-6f;
    CHECK_THROWS_AS(validate(scene), Error);
}

TEST_CASE("validate: limits are errors of their own kind and give both numbers") {
    struct Limit {
        const char* expected;
        std::function<void(Scene&)> exceed;
    };
    const Limit limits[] = {
        {"objects[0] \"floor\": objectId: expected at most 65535, got 65536",
         [](Scene& s) { s.objects[0].objectId = 65536; }},
        {"materials: expected at most 65535, got 65536", [](Scene& s) { s.materials.resize(65536); }},
        {"linkGroups: expected at most 4096, got 4097", [](Scene& s) { s.linkGroups.resize(4097); }},
        {"lightVolumes[0] \"shape\": triangles: expected at most 16384, got 16385",
         [](Scene& s) { s.lightVolumes[0].indices.resize(3 * 16385); }},
        {"functions: expected at most 1024, got 1025", [](Scene& s) { s.functions.resize(1025); }},
    };
    for (const Limit& limit : limits) {
        CAPTURE(limit.expected);
        Scene scene = completeScene();
        limit.exceed(scene);
        try {
            validate(scene);
            FAIL_CHECK("accepted");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::limit);
            CHECK(std::string(error.what()) == limit.expected);
        }
    }
}
