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

/// Per object whether it is chosen: by `includeKey`'s patterns, or else if `chosen` says so, and not by `excludeKey`'s.
std::vector<bool> chosenObjects(const JsonNode& entry, std::string_view includeKey, std::string_view excludeKey,
                                std::vector<bool> chosen, const Scene& scene) {
    if (const auto include = entry.find(includeKey)) {
        chosen.assign(scene.objects.size(), false);
        for (const size_t i : select(*include, "object", scene.objects)) chosen[i] = true;
    }
    if (const auto exclude = entry.find(excludeKey)) {
        for (const size_t i : select(*exclude, "object", scene.objects)) chosen[i] = false;
    }
    return chosen;
}

/// The same by object ID.
std::vector<bool> byId(const std::vector<bool>& chosen, const Scene& scene) {
    uint32_t ids = 0;
    for (const Object& object : scene.objects) ids = std::max(ids, object.objectId + 1);
    std::vector<bool> result(ids);
    for (size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i]) result[scene.objects[i].objectId] = true;
    }
    return result;
}

LinkGroup resolve(const JsonNode& entry, Scene& scene) {
    const std::vector<bool> all(scene.objects.size(), true);
    const std::vector<bool> lit = chosenObjects(entry, "include", "exclude", all, scene);
    const std::vector<bool> casting = chosenObjects(entry, "castInclude", "castExclude", all, scene);
    LinkGroup group{entry.at("name").string(), byId(lit, scene), byId(casting, scene)};
    warnOfSharedIds(group, lit, scene);
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
        entry.expectKeys({"name", "include", "exclude", "castInclude", "castExclude"});
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
