#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/hall.hpp"
#include "scene/builtin/lighting.hpp"
#include "scene/builtin/shapes.hpp"
#include "scene/random.hpp"

/// A colonnade along -Z: a nave under a barrel vault, two aisles under beams, niches in the outer walls, an apse at the
/// end.
///
///      outer wall   aisle   column    nave    column   aisle   outer wall
///    x  -8 |                  -4        0        4                | 8
namespace luciole {

namespace {

using namespace hall;

/// How finely the hall is cut up.
struct Fineness {
    int bays = 10;
    int detail = 0;  ///< triangles grow with its square
    int segments() const { return 5 + detail; }
    int steps() const { return 1 + detail / 8; }            ///< between two points of a profile
    int archSteps() const { return 2 * (2 + detail / 2); }  ///< even, see shapes::niche
    bool furnished() const { return detail >= 3; }
};

struct HallMaterials {
    uint32_t floor, stone, marble, plaster, wood, bronze, terracotta, ceramic, gold, velvet, vein;
};

HallMaterials addHallMaterials(Scene& scene) {
    const uint32_t lambert = addFunction(scene, {.name = "lambert", .kind = Function::Kind::lambert});
    const uint32_t soft = addFunction(scene, {.name = "soft", .kind = Function::Kind::wrap, .parameter = 0.5f});
    const uint32_t clay = addFunction(scene, {.name = "clay", .kind = Function::Kind::orenNayar, .parameter = 0.5f});
    const uint32_t glaze = addFunction(scene, {.name = "glaze", .kind = Function::Kind::blinnPhong, .parameter = 120});
    const uint32_t sheen = addFunction(scene, {.name = "sheen", .kind = Function::Kind::blinnPhong, .parameter = 12});
    const auto plain = [&](const char* name, vec3 color, float metallic, float roughness) {
        return Material{.name = name, .baseColor = vec4(color, 1), .metallic = metallic, .roughness = roughness};
    };
    const auto shaped = [&](const char* name, vec3 color, uint32_t fa, uint32_t fb, vec3 highlight, float ks,
                            float blend) {
        Material material = plain(name, color, 0, 1);
        material.equation = LightEquation::shaped;
        material.shaped = {.diffuseFunction = fa,
                           .specularFunction = fb,
                           .specularColor = highlight,
                           .ks = ks,
                           .specularBlend = blend,
                           .kAmbient = color};
        return material;
    };
    const auto patterned = [](Material material, SurfaceShader surface, vec3 second, float scale) {
        material.surface = surface;
        material.proceduralColor = second;
        material.proceduralScale = scale;
        return material;
    };
    HallMaterials made{};
    made.floor = addMaterial(scene, patterned(plain("floor tiles", {0.46f, 0.41f, 0.34f}, 0, 0.33f),
                                              SurfaceShader::checker, {0.09f, 0.085f, 0.09f}, 1.0f));
    made.stone = addMaterial(scene, plain("sandstone", {0.52f, 0.44f, 0.34f}, 0, 0.85f));
    made.marble = addMaterial(scene, patterned(plain("column marble", {0.7f, 0.66f, 0.6f}, 0, 0.3f),
                                               SurfaceShader::marble, {0.27f, 0.22f, 0.2f}, 0.9f));
    made.plaster = addMaterial(scene, plain("plaster", {0.6f, 0.53f, 0.43f}, 0, 0.95f));
    made.wood = addMaterial(scene, plain("oak", {0.16f, 0.085f, 0.045f}, 0, 0.6f));
    made.bronze = addMaterial(scene, plain("bronze", {0.72f, 0.43f, 0.2f}, 1, 0.38f));
    made.terracotta = addMaterial(scene, shaped("terracotta", {0.5f, 0.19f, 0.09f}, clay, sheen, vec3(0.1f), 1, 0));
    made.ceramic =
        addMaterial(scene, shaped("glazed ceramic", {0.05f, 0.14f, 0.34f}, lambert, glaze, vec3(1), 1.5f, 0));
    made.gold = addMaterial(scene, shaped("gold leaf", {0.25f, 0.15f, 0.04f}, lambert, sheen, {1, 0.7f, 0.28f}, 1, 1));
    made.velvet =
        addMaterial(scene, shaped("velvet", {0.33f, 0.03f, 0.05f}, soft, sheen, {0.3f, 0.05f, 0.06f}, 0.5f, 0));
    made.vein = addMaterial(scene, patterned(plain("green marble", {0.07f, 0.2f, 0.14f}, 0, 0.15f),
                                             SurfaceShader::marble, {0.55f, 0.6f, 0.5f}, 1.7f));
    return made;
}

/// Makes metallic-roughness materials of one colour of all, as near to their looks as these come.
void makeGltf(Scene& scene) {
    for (Material& material : scene.materials) {
        material.surface = SurfaceShader::textured;
        if (material.equation != LightEquation::shaped) continue;
        material.equation = LightEquation::metallicRoughness;
        material.metallic = material.shaped.specularBlend;
        material.roughness = scene.functions[material.shaped.specularFunction].parameter > 50 ? 0.2f : 0.5f;
        material.shaped = {};
    }
    scene.functions.clear();
}

/// Turned about +Y so that what faced +Z faces the nave from the side `side` (-1 left, 1 right).
mat4 facingNave(float side, vec3 position) { return placed(position, side < 0 ? float(kPi) / 2 : -float(kPi) / 2); }

Mesh columnMesh(const Fineness& fine) {
    constexpr std::array<vec2, 4> kPlain = {vec2{0.5f, 0.25f}, {0.42f, 0.6f}, {0.36f, 4.0f}, {0.55f, 4.4f}};
    constexpr std::array<vec2, 27> kTurned = {
        vec2{0.54f, 0.25f}, {0.56f, 0.31f},  {0.54f, 0.37f}, {0.54f, 0.37f}, {0.49f, 0.38f}, {0.47f, 0.43f},
        {0.49f, 0.48f},     {0.49f, 0.48f},  {0.51f, 0.5f},  {0.52f, 0.54f}, {0.49f, 0.58f}, {0.49f, 0.58f},
        {0.45f, 0.6f},      {0.425f, 0.68f}, {0.42f, 1.4f},  {0.405f, 2.4f}, {0.36f, 3.86f}, {0.36f, 3.86f},
        {0.4f, 3.88f},      {0.41f, 3.92f},  {0.37f, 3.96f}, {0.37f, 3.96f}, {0.37f, 4.06f}, {0.4f, 4.16f},
        {0.48f, 4.27f},     {0.55f, 4.33f},  {0.57f, 4.4f}};
    Mesh mesh = fine.furnished() ? shapes::lathe(shapes::smoothProfile(kTurned, fine.steps()), fine.segments())
                                 : shapes::lathe(kPlain, fine.segments());
    shapes::append(mesh, shapes::box({-0.6f, 0, -0.6f}, {0.6f, 0.25f, 0.6f}));
    shapes::append(mesh, shapes::box({-0.62f, 4.4f, -0.62f}, {0.62f, kSpring, 0.62f}));
    return mesh;
}

/// One bay of the wall on the columns, around x = 0, facing +Z and -Z.
Mesh arcadeMesh(const Fineness& fine) {
    const shapes::Arch arch{.radius = 1.72f, .spring = kSpring, .foot = kSpring, .steps = fine.archSteps()};
    Mesh face = shapes::archedWall(arch, kBay, kSpring, kCornice);
    if (fine.furnished()) shapes::append(face, shapes::archMoulding(arch, 0.22f, 0.09f, 2 + fine.detail / 4));
    const mat4 front = glm::translate(mat4(1), vec3(0, 0, kHalfArcade));
    Mesh mesh;
    shapes::append(mesh, face, front);
    shapes::append(mesh, face, glm::rotate(mat4(1), float(kPi), vec3(0, 1, 0)) * front);
    shapes::append(mesh, shapes::archLining(arch, 2 * kHalfArcade, false), front);
    return mesh;
}

/// Transverse rib of the vault, around z = 0.
Mesh ribMesh(const Fineness& fine) {
    constexpr float kDepth = 0.6f;
    const shapes::Arch arch{.radius = kNaveX - 0.25f, .spring = kCornice, .foot = kCornice, .steps = fine.archSteps()};
    const auto ring = [&](double u, double v) {
        const double radius = glm::mix(double(kNaveX), double(arch.radius), u);
        return dvec3(radius * std::cos(kPi * v), kCornice + radius * std::sin(kPi * v), 0);
    };
    const Mesh back = shapes::patch(1, arch.steps, ring, {0.25f, float(kPi) * kNaveX});
    const mat4 toFront = glm::translate(mat4(1), vec3(0, 0, kDepth / 2));
    const mat4 toBack = glm::translate(mat4(1), vec3(0, 0, -kDepth / 2));
    Mesh mesh;
    shapes::append(mesh, shapes::archLining(arch, kDepth, false), toFront);
    shapes::append(mesh, back, toBack);
    shapes::append(mesh, back, toFront * glm::rotate(mat4(1), float(kPi), vec3(0, 1, 0)));
    return mesh;
}

constexpr float kNicheRadius = 0.9f, kNicheFoot = 0.8f;

/// One bay of an outer wall in z = 0, facing +Z.
Mesh outerWallMesh(const Fineness& fine) {
    const shapes::Arch arch{.radius = kNicheRadius, .spring = 2.7f, .foot = kNicheFoot, .steps = fine.archSteps()};
    Mesh mesh = shapes::archedWall(arch, kBay, 0, kAisleTop);
    shapes::append(mesh, shapes::niche(arch));
    if (fine.furnished()) {
        shapes::append(mesh, shapes::archMoulding(arch, 0.14f, 0.07f, 2 + fine.detail / 4));
        shapes::append(mesh, shapes::box({-1.15f, 0.66f, -0.05f}, {1.15f, 0.8f, 0.12f}));
    }
    return mesh;
}

Mesh pilasterMesh() {
    Mesh mesh = shapes::box({-0.35f, 0, -0.05f}, {0.35f, kAisleTop, 0.18f});
    shapes::append(mesh, shapes::box({-0.42f, 0, -0.05f}, {0.42f, 0.35f, 0.26f}));
    shapes::append(mesh, shapes::box({-0.42f, kAisleTop - 0.75f, -0.05f}, {0.42f, kAisleTop - 0.5f, 0.26f}));
    return mesh;
}

Mesh turnedMesh(std::span<const vec2> profile, const Fineness& fine) {
    return shapes::lathe(shapes::smoothProfile(profile, fine.steps()), fine.segments());
}

Mesh urnMesh(const Fineness& fine) {
    constexpr std::array<vec2, 15> kProfile = {vec2{0.24f, 0}, {0.24f, 0.05f}, {0.24f, 0.05f}, {0.12f, 0.09f},
                                               {0.11f, 0.16f}, {0.28f, 0.34f}, {0.36f, 0.58f}, {0.32f, 0.8f},
                                               {0.18f, 0.94f}, {0.15f, 1.02f}, {0.23f, 1.12f}, {0.23f, 1.12f},
                                               {0.19f, 1.1f},  {0.12f, 1.03f}, {0, 0.96f}};
    return turnedMesh(kProfile, fine);
}

/// A draped figure, as abstract as a chessman.
Mesh figureMesh(const Fineness& fine) {
    constexpr std::array<vec2, 17> kProfile = {
        vec2{0.34f, 0}, {0.34f, 0.12f},  {0.34f, 0.12f}, {0.29f, 0.13f}, {0.27f, 0.4f},  {0.2f, 0.85f},
        {0.23f, 1.15f}, {0.29f, 1.35f},  {0.24f, 1.46f}, {0.09f, 1.52f}, {0.08f, 1.58f}, {0.08f, 1.58f},
        {0.13f, 1.64f}, {0.155f, 1.74f}, {0.13f, 1.85f}, {0.07f, 1.91f}, {0, 1.93f}};
    return turnedMesh(kProfile, fine);
}

Mesh benchMesh() {
    Mesh mesh = shapes::box({-0.8f, 0.4f, -0.24f}, {0.8f, 0.5f, 0.24f});
    shapes::append(mesh, shapes::box({-0.7f, 0, -0.2f}, {-0.56f, 0.4f, 0.2f}));
    shapes::append(mesh, shapes::box({0.56f, 0, -0.2f}, {0.7f, 0.4f, 0.2f}));
    return mesh;
}

/// Calls `use(side, name)` for the left and the right of the nave.
template <class Use>
void onBothSides(const Use& use) {
    use(-1.0f, "left");
    use(1.0f, "right");
}

void addColumns(Scene& scene, const HallMaterials& material, const Fineness& fine) {
    const uint32_t column = addMesh(scene, columnMesh(fine), "column");
    for (int i = 0; i <= fine.bays; ++i)
        onBothSides([&](float side, const char* where) {
            addObject(scene, fmt::format("column {} {}", where, i), column, material.marble,
                      placed({side * kColumnX, 0, -kBay * float(i)}, (2 * float(i) + side) * float(kPi) / 2));
        });
}

void addBays(Scene& scene, const HallMaterials& material, const Fineness& fine) {
    const shapes::Arch vaultArch{.radius = kNaveX, .spring = kCornice, .foot = kCornice, .steps = fine.archSteps()};
    const uint32_t vault = addMesh(scene, shapes::archLining(vaultArch, kBay, false), "vault");
    const uint32_t arcade = addMesh(scene, arcadeMesh(fine), "arcade");
    const uint32_t wall = addMesh(scene, outerWallMesh(fine), "wall");
    for (int i = 0; i < fine.bays; ++i) {
        const float end = -kBay * float(i), middle = end - kBay / 2;
        addObject(scene, fmt::format("vault {}", i), vault, material.plaster, placed({0, 0, end}));
        onBothSides([&](float side, const char* where) {
            addObject(scene, fmt::format("arcade {} {}", where, i), arcade, material.stone,
                      facingNave(side, {side * kColumnX, 0, middle}));
            addObject(scene, fmt::format("wall {} {}", where, i), wall, material.stone,
                      facingNave(side, {side * kWallX, 0, middle}));
        });
    }
}

/// Ribs of the vault, pilasters along the outer walls, beams under the ceilings of the aisles.
void addTrim(Scene& scene, const HallMaterials& material, const Fineness& fine) {
    constexpr int kBeamsPerBay = 3;
    const uint32_t rib = addMesh(scene, ribMesh(fine), "rib");
    const uint32_t pilaster = addMesh(scene, pilasterMesh(), "pilaster");
    const uint32_t beam =
        addMesh(scene, shapes::box({0, -0.34f, -0.13f}, {kWallX - kColumnX - kHalfArcade, 0, 0.13f}), "beam");
    for (int i = 0; i <= fine.bays; ++i) {
        const float z = -kBay * float(i);
        addObject(scene, fmt::format("rib {}", i), rib, material.stone, placed({0, 0, z}));
        onBothSides([&](float side, const char* where) {
            addObject(scene, fmt::format("pilaster {} {}", where, i), pilaster, material.stone,
                      facingNave(side, {side * kWallX, 0, z}));
        });
    }
    for (int i = 0; i < fine.bays * kBeamsPerBay; ++i)
        onBothSides([&](float side, const char* where) {
            const float inner = side < 0 ? -kWallX : kColumnX + kHalfArcade;
            addObject(scene, fmt::format("beam {} {}", where, i), beam, material.wood,
                      placed({inner, kAisleTop, -kBay * (float(i) + 0.5f) / kBeamsPerBay}));
        });
}

/// What runs along the whole hall, and its two ends.
void addEnds(Scene& scene, const HallMaterials& material, const Fineness& fine) {
    const float length = kBay * float(fine.bays);
    const uint32_t cornice =
        addMesh(scene, shapes::box({-length / 2, kCornice - 0.22f, -0.05f}, {length / 2, kCornice, 0.2f}), "cornice");
    const uint32_t ceiling = addMesh(
        scene, shapes::rectangle({0, kAisleTop, 0}, {0, 0, -length}, {kWallX - kColumnX, 0, 0}), "aisle ceiling");
    onBothSides([&](float side, const char* where) {
        addObject(scene, fmt::format("cornice {}", where), cornice, material.marble,
                  facingNave(side, {side * kNaveX, 0, -length / 2}));
        addObject(scene, fmt::format("aisle ceiling {}", where), ceiling, material.plaster,
                  placed({side < 0 ? -kWallX : kColumnX, 0, 0}));
    });
    const shapes::Arch arch{.radius = 2.6f, .spring = 4, .foot = 0.6f, .steps = fine.archSteps()};
    Mesh apse = shapes::archedWall(arch, 2 * kWallX, 0, kTop);
    shapes::append(apse, shapes::niche(arch));
    if (fine.furnished()) shapes::append(apse, shapes::archMoulding(arch, 0.3f, 0.14f, 2 + fine.detail / 4));
    addObject(scene, "apse", addMesh(scene, std::move(apse), "apse"), material.stone, placed({0, 0, -length}));
    const Mesh entrance = shapes::rectangle({kWallX, 0, 0}, {-2 * kWallX, 0, 0}, {0, kTop, 0});
    addObject(scene, "entrance", addMesh(scene, entrance, "entrance"), material.stone);
}

/// Things that stand around. \return where lights can't hang, the columns included
std::vector<HallSolid> addFurniture(Scene& scene, const HallMaterials& material, const Fineness& fine, uint32_t seed) {
    std::vector<HallSolid> solids;
    for (int i = 0; i <= fine.bays; ++i)
        for (const float side : {-1.0f, 1.0f}) solids.push_back({{side * kColumnX, -kBay * float(i)}, 0.88f, kSpring});
    if (!fine.furnished()) return solids;
    Random random(seed, 1);
    const float length = kBay * float(fine.bays);
    const uint32_t urn = addMesh(scene, urnMesh(fine), "urn");
    const uint32_t figure = addMesh(scene, figureMesh(fine), "figure");
    const uint32_t bench = addMesh(scene, benchMesh(), "bench");
    const uint32_t ball = addMesh(scene, shapes::sphere(0.45f, 2 * fine.segments(), fine.segments()), "ball");
    const uint32_t step = addMesh(scene, shapes::box({-2.4f, 0, -0.4f}, {2.4f, 0.3f, 0.4f}), "step");
    const uint32_t pedestal = addMesh(scene, shapes::box({-0.5f, 0, -0.5f}, {0.5f, 0.9f, 0.5f}), "pedestal");
    const std::array<uint32_t, 5> finishes = {material.terracotta, material.ceramic, material.gold, material.bronze,
                                              material.terracotta};
    const auto stand = [&](const char* name, int i, uint32_t mesh, uint32_t finish, vec3 at, float size, float radius,
                           float height) {
        const float turn = float(random.between(0, 2 * kPi));
        addObject(scene, fmt::format("{} {}", name, i), mesh, finish, placed(at, turn, size));
        solids.push_back({{at.x, at.z}, size * radius, at.y + size * height});
    };
    for (int i = 0; i < fine.bays; ++i) {
        const float middle = -kBay * (float(i) + 0.5f);
        for (const float side : {-1.0f, 1.0f}) {
            const int n = 2 * i + (side > 0);
            const vec3 inNiche(side * (kWallX + 0.35f), kNicheFoot, middle);
            if ((n + int(seed)) % 2 == 0)
                stand("figure", n, figure, n % 4 < 2 ? material.marble : material.bronze, inNiche, 1.0f, 0.36f, 1.95f);
            else
                stand("urn", n, urn, finishes[random.below(5)], inNiche, 1.15f, 0.36f, 1.12f);
            const uint32_t kind = random.below(4);
            const vec3 underArch(side * (kColumnX + 0.1f), 0, middle + float(random.between(-0.7, 0.7)));
            if (kind == 0) stand("large urn", n, urn, finishes[random.below(5)], underArch, 1.3f, 0.36f, 1.12f);
            if (kind == 1) stand("ball", n, ball, material.vein, underArch + vec3(0, 0.45f, 0), 1, 0.45f, 0.45f);
            if (kind == 2) {
                addObject(scene, fmt::format("bench {}", n), bench, material.velvet, facingNave(side, underArch));
                solids.push_back({{underArch.x, underArch.z}, 0.9f, 0.5f});
            }
        }
    }
    addObject(scene, "step", step, material.marble, placed({0, 0, -length + 0.4f}));
    solids.push_back({{0, -length}, 2.6f, 0.6f});
    addObject(scene, "pedestal", pedestal, material.vein, placed({0, 0.6f, -length - 0.9f}));
    addObject(scene, "the founder", figure, material.gold, placed({0, 1.5f, -length - 0.9f}, 0, 1.35f));
    solids.push_back({{0, -length - 0.9f}, 0.8f, 4.2f});
    return solids;
}

/// The floor takes what the rest leaves over, so that the total is met.
void addFloor(Scene& scene, const HallMaterials& material, const Fineness& fine, uint64_t triangles) {
    const float length = kBay * float(fine.bays), width = 2 * kWallX;
    const auto quads = double(std::max<uint64_t>(triangles / 2, 1));
    const int across = std::max(1, int(std::sqrt(quads * double(width / length))));
    const int along = std::max(1, int(std::lround(quads / across)));
    addObject(
        scene, "floor",
        addMesh(scene, shapes::rectangle({-kWallX, 0, 0}, {width, 0, 0}, {0, 0, -length}, across, along), "floor"),
        material.floor);
}

Camera hallCamera(const Fineness& fine) {
    const float length = kBay * float(fine.bays);
    return {
        .name = "nave", .worldFromView = lookAt({-2.3f, 1.75f, -1.6f}, {1.5f, 3.1f, -0.6f * length}), .yFov = 1.05f};
}

struct Hall {
    Scene scene;
    HallMaterials materials;
    std::vector<HallSolid> solids;
};

/// All but floor and lights.
Hall makeBuilding(const Fineness& fine, uint32_t seed) {
    Hall hall;
    hall.materials = addHallMaterials(hall.scene);
    addColumns(hall.scene, hall.materials, fine);
    addBays(hall.scene, hall.materials, fine);
    if (fine.furnished()) addTrim(hall.scene, hall.materials, fine);
    addEnds(hall.scene, hall.materials, fine);
    hall.solids = addFurniture(hall.scene, hall.materials, fine, seed);
    return hall;
}

/// The finest hall of at most `triangles`, with fewer bays where even the coarsest is too much.
Fineness fit(uint32_t triangles, uint32_t seed) {
    const auto fits = [&](const Fineness& fine) { return triangleCount(makeBuilding(fine, seed).scene) <= triangles; };
    Fineness fine;
    while (fine.bays > 2 && !fits(fine)) --fine.bays;
    int tooFine = 1;
    while (fits({fine.bays, tooFine})) tooFine *= 2;
    while (tooFine - fine.detail > 1) {
        const int middle = (fine.detail + tooFine) / 2;
        (fits({fine.bays, middle}) ? fine.detail : tooFine) = middle;
    }
    return fine;
}

}  // namespace

Scene makeHall(const HallOptions& options) {
    constexpr uint32_t kLampTriangles = 8;
    constexpr double kLampShare = 0.1;    // of the triangles
    constexpr double kBrightness = 0.18;  // radiance; shows as a middle grey at exposure 0
    const auto lamps = std::min(options.lights, uint32_t(options.triangles * kLampShare / kLampTriangles));
    const uint32_t triangles = options.triangles - lamps * kLampTriangles;
    const Fineness fine = fit(triangles, options.seed);
    auto [scene, materials, solids] = makeBuilding(fine, options.seed);
    addFloor(scene, materials, fine, triangles - triangleCount(scene));

    if (options.gltf) makeGltf(scene);

    const Camera camera = hallCamera(fine);
    scene.cameras.push_back(camera);
    scene.ambience = {.sky = {0.016f, 0.02f, 0.034f}, .ground = {0.022f, 0.016f, 0.012f}};
    addHallLights(scene, options, fine.bays, solids, vec3(camera.worldFromView[3]), lamps);
    if (scene.lights.empty()) return scene;

    const std::vector<VisiblePoint> points = visiblePoints(scene, camera, 192, 144);
    const double reached = fitRange(scene.lights, points, options.overlap);
    if (std::abs(reached - options.overlap) > 0.02 * options.overlap)
        scene.warnings.push_back(
            fmt::format("builtin:hall: {} lights can't overlap {} times in this view; the nearest is {:.3g}",
                        options.lights, options.overlap, reached));
    fitBrightness(scene.lights, points, kBrightness);
    return scene;
}

}  // namespace luciole
