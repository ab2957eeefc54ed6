#include <string>
#include <utility>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "io/file.hpp"
#include "scene/rig/sections.hpp"

namespace luciole {
namespace {

/// The lists that no rig changes and that are too large to copy.
void swapBulk(Scene& a, Scene& b) noexcept {
    a.meshes.swap(b.meshes);
    a.texels.swap(b.texels);
    a.textures.swap(b.textures);
}

/// Lends the bulky lists of one scene to another for as long as it lives.
class BulkLoan {
public:
    BulkLoan(Scene& owner, Scene& borrower) : owner_(owner), borrower_(borrower) { swapBulk(owner_, borrower_); }
    ~BulkLoan() { swapBulk(owner_, borrower_); }
    BulkLoan(const BulkLoan&) = delete;
    BulkLoan& operator=(const BulkLoan&) = delete;

private:
    Scene& owner_;
    Scene& borrower_;
};

Scene copyWithoutBulk(Scene& scene) {
    Scene parking;
    const BulkLoan loan(scene, parking);
    return scene;
}

void applySections(const JsonNode& rig, Scene& scene, const LoadLimits& limits) {
    rig.expectKeys({"$schema", "description", "functions", "objects", "lightVolumes", "linkGroups", "materials", "lights",
                    "ambience", "cameras", "exposure"});
    if (const auto v = rig.find("$schema")) v->string();
    if (const auto v = rig.find("description")) v->string();
    if (const auto v = rig.find("functions")) rig::applyFunctions(*v, scene);
    if (const auto v = rig.find("objects")) rig::applyObjects(*v, scene);
    if (const auto v = rig.find("lightVolumes")) rig::applyLightVolumes(*v, scene, limits);
    if (const auto v = rig.find("linkGroups")) rig::applyLinkGroups(*v, scene);
    if (const auto v = rig.find("materials")) rig::applyMaterials(*v, scene);
    if (const auto v = rig.find("lights")) rig::applyLights(*v, scene, limits);
    if (const auto v = rig.find("ambience")) rig::applyAmbience(*v, scene);
    if (const auto v = rig.find("cameras")) rig::applyCameras(*v, scene);
    if (const auto v = rig.find("exposure")) scene.exposureEv = float(v->number());
}

/// The sections check what they read; this catches what only shows in the whole, such as a colour times an intensity.
void validateResult(const Scene& scene, const std::string& nameForErrors) {
    try {
        validate(scene);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", nameForErrors, error.what()));
    }
}

}  // namespace

void applyRig(Scene& scene, const std::filesystem::path& file, const LoadLimits& limits) {
    const std::vector<std::byte> bytes = readFile(file, limits.maxFileBytes);
    applyRigText(scene, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file.string(),
                 limits);
}

void applyRigText(Scene& scene, std::string_view json, const std::string& nameForErrors, const LoadLimits& limits) {
    const nlohmann::json document = parseJson(json, nameForErrors, limits);
    Scene draft = copyWithoutBulk(scene);
    {
        const BulkLoan loan(scene, draft);
        applySections(JsonNode(document, nameForErrors), draft, limits);
        validateResult(draft, nameForErrors);
    }
    swapBulk(scene, draft);
    scene = std::move(draft);
}

}  // namespace luciole
