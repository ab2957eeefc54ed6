#include <algorithm>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

/// Objects that share an ID are lit alike; says so where a group asks for something else.
void warnOfSharedIds(const LinkGroup& group, const std::vector<bool>& wanted, Scene& scene) {
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (wanted[i] || !group.litObjects[object.objectId]) continue;
        scene.warnings.push_back(fmt::format("link group \"{}\": touches object \"{}\" too, which shares its ID {}",
                                             group.name, object.name, object.objectId));
        return;
    }
}

LinkGroup resolve(const JsonNode& entry, Scene& scene) {
    std::vector<bool> wanted(scene.objects.size(), !entry.find("include"));
    if (const auto include = entry.find("include")) {
        for (const size_t i : select(*include, "object", scene.objects)) wanted[i] = true;
    }
    if (const auto exclude = entry.find("exclude")) {
        for (const size_t i : select(*exclude, "object", scene.objects)) wanted[i] = false;
    }
    uint32_t ids = 0;
    for (const Object& object : scene.objects) ids = std::max(ids, object.objectId + 1);
    LinkGroup group{entry.at("name").string(), std::vector<bool>(ids)};
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i]) group.litObjects[scene.objects[i].objectId] = true;
    }
    warnOfSharedIds(group, wanted, scene);
    return group;
}

/// Per material whether the entry asks for it. One node may hold a whole building, told apart by materials only.
std::vector<bool> chosenMaterials(const JsonNode& entry, const Scene& scene) {
    const auto patterns = entry.find("withMaterial");
    std::vector<bool> chosen(scene.materials.size(), !patterns);
    if (patterns) {
        for (const size_t i : select(*patterns, "material", scene.materials)) chosen[i] = true;
    }
    return chosen;
}

}  // namespace

void applyObjects(const JsonNode& list, Scene& scene) {
    for (const JsonNode& entry : list.elements()) {
        entry.expectKeys({"match", "withMaterial", "objectId"});
        const auto id = uint32_t(entry.at("objectId").integer(0, kMaxObjectId));
        const std::vector<bool> materials = chosenMaterials(entry, scene);
        for (const size_t i : select(entry.at("match"), "object", scene.objects)) {
            if (materials[scene.objects[i].material]) scene.objects[i].objectId = id;
        }
    }
}

void applyLinkGroups(const JsonNode& list, Scene& scene) {
    for (const JsonNode& entry : list.elements()) {
        entry.expectKeys({"name", "include", "exclude"});
        LinkGroup group = resolve(entry, scene);
        const size_t index = indexOf(scene.linkGroups, group.name);
        if (index < scene.linkGroups.size()) {
            scene.linkGroups[index] = std::move(group);
        } else if (index < kMaxLinkGroups) {
            scene.linkGroups.push_back(std::move(group));
        } else {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} link groups in the scene, got {}",
                                                      entry.where(), kMaxLinkGroups, kMaxLinkGroups + 1));
        }
    }
}

}  // namespace luciole::rig
