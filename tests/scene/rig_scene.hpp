#pragma once
#include <string>

#include <luciole/scene_io.hpp>

/// What the rig tests have in common: a small scene and a rig that says everything about it.
namespace luciole::test {

/// Three objects with one mesh, two materials, two lights and a camera.
inline Scene plainScene() {
    Scene scene;
    scene.meshes = {{.name = "triangle", .vertices = std::vector<Vertex>(3), .indices = {0, 1, 2}}};
    scene.meshes[0].vertices[1].position = {4, 0, 0};
    scene.meshes[0].vertices[2].position = {0, 2, -6};
    scene.objects = {{.name = "curtain left", .objectId = 0},
                     {.name = "curtain right", .objectId = 1},
                     {.name = "floor", .material = 1, .objectId = 2}};
    scene.materials = {{.name = "red cloth"}, {.name = "stone"}};
    scene.texels = {{.name = "dot", .width = 1, .height = 1, .rgba = {1, 2, 3, 4}}};
    scene.textures = {{}};
    scene.materials[1].baseColorTexture.texture = 0;
    scene.lights = {{.name = "lamp 1", .color = {2, 4, 1}}, {.name = "sun", .type = LightType::directional}};
    scene.cameras = {{.name = "door"}};
    return scene;
}

inline Scene rigged(const std::string& rig, Scene scene = plainScene()) {
    applyRigText(scene, rig, "test.json");
    return scene;
}

/// A rig that has every section and every key.
inline const std::string kFullRig = R"({
  "$schema": "rig.schema.json", "description": "everything",
  "functions": [{"name": "half", "kind": "wrap", "parameter": 0.5},
                {"name": "curve", "kind": "sampled", "samples": [[0, 0], [0.25, 1], [1, 1]]}],
  "objects": [{"match": "curtain*", "objectId": 7}],
  "lightVolumes": [
    {"name": "room", "box": {"low": [-1, -2, -3], "high": [4, 5, 6]}},
    {"name": "spike", "mesh": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
     "indices": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]}}],
  "linkGroups": [{"name": "cloth", "include": "curtain*", "exclude": ["floor"], "castInclude": ["*"], "castExclude": "curtain left"}],
  "materials": [
    {"match": "red*", "equation": "shaped", "diffuseFunction": "half", "specularFunction": {"kind": "toon", "parameter": 2},
     "kd": 0.5, "ks": 0.25, "specularColor": [1, 0.5, 0], "specularBlend": 0.75, "kAmbient": [0.1, 0.2, 0.3], "kEmissive": 2,
     "alphaMode": "blend"},
    {"name": "tiles", "copyOf": "stone", "assignTo": "floor", "surface": "checker", "proceduralColor": "#000000",
     "proceduralScale": 3, "baseColor": [1, 0.5, 0.25, 0.5], "metallic": 0.5, "roughness": 0.25, "emissive": [2, 0, 0],
     "normalScale": 2, "occlusionStrength": 0.5, "doubleSided": true, "castsShadows": false,
     "alphaMode": "mask", "alphaCutoff": 0.25}],
  "lights": [
    {"name": "key", "type": "spot", "position": [1, 2, 3], "target": [1, 0, 3], "color": [1, 0.5, 0.25], "intensity": 8,
     "range": 5, "innerConeAngle": 30, "outerConeAngle": 60, "attenuation": "linear", "falloff": "lambert",
     "contribution": "specularOnly", "linkGroup": "cloth", "volume": "spike",
     "castsShadows": false, "shadowSoftness": 0.5, "shadowResolution": 4},
    {"name": "moon", "type": "directional", "direction": [0, -2, 0], "infiniteViewer": true, "volume": "room"},
    {"name": "spark", "type": "point", "scatter": {"count": 4, "seed": 9, "box": "bounds", "jitter": 0.5, "hue": [30, 60],
     "saturation": 0.5, "intensity": [1, 2], "range": [3, 4]}},
    {"match": "lamp*", "intensityScale": 0.5}, {"remove": "sun"}],
  "ambience": {"sky": [0.1, 0.2, 0.3], "ground": [0, 0, 0], "up": [0, 3, 0]},
  "cameras": [{"name": "nave", "eye": [0, 1, 5], "target": [0, 1, 0], "fov": 60, "near": 0.5},
              {"name": "plan", "matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 9, 0, 1], "orthographic": 6, "near": 0, "far": 20}],
  "exposure": -1.5
})";

}  // namespace luciole::test
