#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <luciole/error.hpp>

#include "rig_scene.hpp"

using namespace luciole;
using namespace luciole::test;
using Json = nlohmann::json;

namespace {

/// The message with which the rig is refused; the scene must be as before.
std::string refusal(const std::string& rig, ErrorKind kind = ErrorKind::scene) {
    Scene scene = plainScene();
    try {
        applyRigText(scene, rig, "test.json", LoadLimits{.maxJsonDepth = 32, .maxElements = 1000});
    } catch (const Error& error) {
        CHECK(error.kind() == kind);
        const Scene before = plainScene();
        CHECK(scene.lights.size() == before.lights.size());
        CHECK(scene.functions.empty());
        CHECK(scene.objects.size() == 3);
        CHECK(scene.lightVolumes.empty());
        CHECK(scene.meshes.size() == 1);
        CHECK(scene.texels.size() == 1);
        CHECK(scene.textures.size() == 1);
        CHECK(scene.materials.size() == 2);
        CHECK(scene.lights[0].color == before.lights[0].color);
        return error.what();
    }
    FAIL_CHECK("accepted: " << rig);
    return {};
}

}  // namespace

TEST_CASE("rig: every fault is refused with its path, and the scene stays as it was") {
    struct Fault {
        const char* rig;
        const char* message;  ///< start
    };
    const Fault faults[] = {
        {"", "test.json: parse error at line 1, column 1"},
        {"{\n \"lights\": [}", "test.json: parse error at line 2, column 13"},
        {"[]", "test.json: /: expected an object, got an array of 0"},
        {R"({"lihgts": []})", "test.json: /lihgts: unknown key; expected one of $schema, "},
        {R"({"exposure": 1, "exposure": 2})", "test.json: key \"exposure\" is given twice in one object"},
        {R"({"exposure": "bright"})", "test.json: /exposure: expected a number that fits into 32 bits, got \"bright\""},
        {R"({"exposure": 1e39})", "test.json: /exposure: expected a number that fits into 32 bits, got 1e+39"},
        {R"({"$schema": 1})", "test.json: /$schema: expected a string, got 1"},
        {R"({"lights": {}})", "test.json: /lights: expected an array, got an object"},
        {R"({"lights": [{"name": "a"}]})", "test.json: /lights/0: expected a key \"type\", got none"},
        {R"({"lights": [{"type": "lamp"}]})",
         "test.json: /lights/0/type: expected one of directional, point, spot, got \"lamp\""},
        {R"({"lights": [{"type": "point"}]})", "test.json: /lights/0: expected a key \"position\", got none"},
        {R"({"lights": [{"type": "directional"}]})", "test.json: /lights/0: expected a key \"direction\", got none"},
        {R"({"lights": [{"type": "point", "position": [0, 1]}]})",
         "test.json: /lights/0/position: expected three numbers, got an array of 2"},
        {R"({"lights": [{"type": "point", "position": [0, 1, "x"]}]})",
         "test.json: /lights/0/position/2: expected a number that fits into 32 bits, got \"x\""},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "range": -1}]})",
         "test.json: /lights/0/range: expected a number > 0, got -1"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": "red"}]})",
         "test.json: /lights/0/color: expected a colour as \"#rrggbb\" or [r, g, b], got \"red\""},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": "#12345g"}]})",
         "test.json: /lights/0/color: "},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": [1, -1, 1]}]})",
         "test.json: /lights/0/color/1: expected a number >= 0, got -1"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": [9e37, 0, 0], "intensity": 9}]})",
         "test.json: /lights/0: expected color times intensity to fit into 32 bits"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "attenuation": "linear"}]})",
         "test.json: /lights/0: expected a range"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "range": 1, "attenuation": "curvy"}]})",
         "test.json: /lights/0/attenuation: expected a built-in function"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "falloff": 3}]})",
         "test.json: /lights/0/falloff: expected a function's name"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "linkGroup": "cloth"}]})",
         "test.json: /lights/0/linkGroup: expected the name of a link group (none), got \"cloth\""},
        {R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})",
         "test.json: /lights/0/direction: expected a direction other than zero"},
        {R"({"lights": [{"type": "directional", "direction": [0, 1, 0], "target": [0, 1, 0]}]})",
         "test.json: /lights/0/target: expected either a direction or a target, got both"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 1, 0]}]})",
         "test.json: /lights/0/target: expected a place other than the light's position"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 0, 0], "innerConeAngle": 50}]})",
         "test.json: /lights/0: expected innerConeAngle < outerConeAngle, got 50 and 45"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 0, 0], "outerConeAngle": 190}]})",
         "test.json: /lights/0/outerConeAngle: expected a number in [0, 180], got 190"},
        {R"({"lights": [{"match": "lmp*", "intensity": 1}]})",
         "test.json: /lights/0/match: pattern \"lmp*\" matches no light; there are: \"lamp 1\", \"sun\""},
        {R"({"lights": [{"remove": ["sun", "moon"]}]})",
         "test.json: /lights/0/remove/1: pattern \"moon\" matches no light"},
        {R"({"lights": [{"remove": "sun", "color": [1, 1, 1]}]})", "test.json: /lights/0/color: unknown key"},
        {R"({"lights": [{"match": []}]})", "test.json: /lights/0/match: expected at least one pattern"},
        {R"({"lights": [{"match": 3}]})",
         "test.json: /lights/0/match: expected a pattern or an array of patterns, got 3"},
        {R"({"lights": [{"match": "*", "intensityScale": 1e38}, {"match": "*", "intensityScale": 1e38}]})",
         "test.json: lights[0] \"lamp 1\": color: expected finite numbers >= 0, got (inf"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 0, "box": "bounds"}}]})",
         "test.json: /lights/0/scatter/count: expected a whole number in [1, "},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2}}]})",
         "test.json: /lights/0/scatter: expected a key \"box\", got none"},
        {R"({"lights": [{"type": "point", "position": [0, 0, 0], "scatter": {"count": 2, "box": "bounds"}}]})",
         "test.json: /lights/0/position: a scattered light takes its position"},
        {R"({"lights": [{"type": "directional", "direction": [0, 0, 1], "scatter": {"count": 2, "box": "bounds"}}]})",
         "test.json: /lights/0/scatter: a directional light has no place to scatter"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "range": [3, 2]}}]})",
         "test.json: /lights/0/scatter/range: expected [low, high] with low <= high, got [3, 2]"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "colors": []}}]})",
         "test.json: /lights/0/scatter/colors: expected at least one colour"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "saturation": 1}}]})",
         "test.json: /lights/0/scatter/saturation: saturation needs a hue"},
        {R"({"functions": [{"kind": "lambert"}]})", "test.json: /functions/0: expected a key \"name\", got none"},
        {R"({"functions": [{"name": "f", "kind": "wrapped"}]})",
         "test.json: /functions/0/kind: expected one of lambert, "},
        {R"({"functions": [{"name": "f", "kind": "wrap", "parameter": 2}]})",
         "test.json: /functions/0/parameter: expected a number in [0, 1], got 2"},
        {R"({"functions": [{"name": "f", "kind": "toon", "parameter": 1.5}]})",
         "test.json: /functions/0/parameter: expected a whole number in [1, 65536], got 1.5"},
        {R"({"functions": [{"name": "f", "kind": "lambert", "parameter": 1}]})",
         "test.json: /functions/0/parameter: lambert has no parameter"},
        {R"({"functions": [{"name": "f", "kind": "lambert", "samples": [0, 1]}]})",
         "test.json: /functions/0/samples: only a sampled function has samples"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1]}]})",
         "test.json: /functions/0/samples: expected at least 2 samples"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1, [1, 1]]}]})",
         "test.json: /functions/0/samples/1: expected a number, as the first sample, got an array of 2"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [[1, 1], [1]]}]})",
         "test.json: /functions/0/samples/1: expected [shape, cascade], as the first sample"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1, 1], "parameter": 1}]})",
         "test.json: /functions/0/parameter: a sampled function has no parameter"},
        {R"({"objects": [{"match": "floor", "objectId": 65536}]})",
         "test.json: /objects/0/objectId: expected a whole number in [0, 65535], got 65536"},
        {R"({"linkGroups": [{"name": "g", "include": "wall*"}]})",
         "test.json: /linkGroups/0/include: pattern \"wall*\" matches no object; there are: \"curtain left\", "},
        {R"({"linkGroups": [{"name": "g", "castExclude": ["floor", "wall*"]}]})",
         "test.json: /linkGroups/0/castExclude/1: pattern \"wall*\" matches no object; there are: \"curtain left\", "},
        {R"({"lightVolumes": [{"box": {"low": [0, 0, 0], "high": [1, 1, 1]}}]})",
         "test.json: /lightVolumes/0: expected a key \"name\", got none"},
        {R"({"lightVolumes": [{"name": "v"}]})",
         "test.json: /lightVolumes/0: expected exactly one of object, box and mesh, got 0"},
        {R"({"lightVolumes": [{"name": "v", "object": "floor", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}]})",
         "test.json: /lightVolumes/0: expected exactly one of object, box and mesh, got 2"},
        {R"({"lightVolumes": [{"name": "v", "object": "floor*"}, {"name": "w", "object": "floor"}]})",
         "test.json: /lightVolumes/0/object: indices: expected a closed surface, triangles turned alike (each edge run "
         "through as often one way as the other), got 3 open edges, one of them from (0, 0, 0) to (4, 0, 0)"},
        {R"({"lightVolumes": [{"name": "v", "object": "wall"}]})",
         "test.json: /lightVolumes/0/object: pattern \"wall\" matches no object"},
        {R"({"lightVolumes": [{"name": "v", "box": {"low": [0, 1, 0], "high": [1, 1, 1]}}]})",
         "test.json: /lightVolumes/0/box: expected low < high on each axis, got 1 and 1 along y"},
        {R"({"lightVolumes": [{"name": "v", "box": {"low": [0, 1, 0]}}]})",
         "test.json: /lightVolumes/0/box: expected a key \"high\", got none"},
        {R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [], "indices": [[0, 0, 0]]}}]})",
         "test.json: /lightVolumes/0/mesh/positions: expected at least one position"},
        {R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": []}}]})",
         "test.json: /lightVolumes/0/mesh/indices: expected at least one triangle"},
        {R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": [[0, 0]]}}]})",
         "test.json: /lightVolumes/0/mesh/indices/0: expected three indices, got an array of 2"},
        {R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": [[0, 0, 1]]}}]})",
         "test.json: /lightVolumes/0/mesh/indices/0/2: expected a whole number in [0, 0], got 1"},
        {R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "indices": [[0, 1, 2]]}}]})",
         "test.json: /lightVolumes/0/mesh: indices: expected a closed surface"},
        {R"({"lights": [{"match": "*", "volume": "v"}]})",
         "test.json: /lights/0/volume: expected the name of a light volume (none), got \"v\""},
        {R"({"lights": [{"match": "*", "shadowSoftness": 5}]})", "test.json: /lights/0/shadowSoftness: expected a number in [0, 4], got 5"},
        {R"({"lights": [{"match": "*", "shadowResolution": 0}]})", "test.json: /lights/0/shadowResolution: expected a number in [0.0625, 16], got 0"},
        {R"({"materials": [{"match": "stone", "castsShadows": 1}]})", "test.json: /materials/0/castsShadows: expected true or false, got 1"},
        {R"({"materials": [{"baseColor": [1, 1, 1]}]})", "test.json: /materials/0: expected a key \"name\", got none"},
        {R"({"materials": [{"match": "stone", "assignTo": "floor"}]})",
         "test.json: /materials/0/assignTo: unknown key"},
        {R"({"materials": [{"match": "stone", "kd": 1}]})",
         "test.json: /materials/0/kd: only for the equation \"shaped\", which material \"stone\" does not have"},
        {R"({"materials": [{"match": "stone", "baseColor": [1, 1, 1, 2]}]})",
         "test.json: /materials/0/baseColor/3: expected a number in [0, 1], got 2"},
        {R"({"materials": [{"name": "a", "copyOf": "brick"}]})",
         "test.json: /materials/0/copyOf: expected the name of a material (\"red cloth\", \"stone\"), got \"brick\""},
        {R"({"materials": [{"match": "stone", "doubleSided": 1}]})",
         "test.json: /materials/0/doubleSided: expected true or false, got 1"},
        {R"({"ambience": {"ambient": [1, 1, 1], "sky": [1, 1, 1]}})",
         "test.json: /ambience/sky: expected either ambient or sky and ground, got both"},
        {R"({"ambience": {"up": [0, 0, 0]}})", "test.json: /ambience/up: expected a direction other than zero"},
        {R"({"cameras": [{"name": "c"}]})", "test.json: /cameras/0: expected a key \"eye\", got none"},
        {R"({"cameras": [{"name": "c", "eye": [0, 0, 0]}]})",
         "test.json: /cameras/0: expected a key \"target\", got none"},
        {R"({"cameras": [{"name": "c", "eye": [1, 0, 0], "target": [1, 0, 0]}]})",
         "test.json: /cameras/0/target: expected a place other than the eye"},
        {R"({"cameras": [{"name": "door", "fov": 180}]})",
         "test.json: /cameras/0/fov: expected a number above 0 and below 180, got 180"},
        {R"({"cameras": [{"name": "door", "fov": 50, "orthographic": 2}]})",
         "test.json: /cameras/0/orthographic: expected either fov or orthographic, got both"},
        {R"({"cameras": [{"name": "door", "near": 0}]})", "test.json: /cameras/0: expected near >= 1e-18"},
        {R"({"cameras": [{"name": "door", "orthographic": 2, "near": 5, "far": 4}]})",
         "test.json: /cameras/0: expected far > near, got 4 and 5"},
        {R"({"cameras": [{"name": "door", "matrix": [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})",
         "test.json: /cameras/0/matrix: expected a rotation and a translation"},
        // The last section fails: what the earlier ones did must not show.
        {R"({"functions": [{"name": "f", "kind": "lambert"}], "lights": [{"remove": "*"}], "exposure": null})",
         "test.json: /exposure: expected a number"},
    };
    for (const Fault& fault : faults) {
        CAPTURE(fault.message);
        const std::string message = refusal(fault.rig);
        CAPTURE(message);
        CHECK(message.starts_with(fault.message));
    }
}

TEST_CASE("rig: limits on nesting, array sizes and numbers of lights and functions are errors of their own kind") {
    refusal(R"({"exposure": )" + std::string(5000, '[') + std::string(5000, ']') + "}", ErrorKind::limit);
    std::string samples = "[0";
    for (int i = 0; i < 1000; ++i) samples += ", 0";
    refusal(R"({"functions": [{"name": "f", "kind": "sampled", "samples": )" + samples + "]}]}", ErrorKind::limit);
    CHECK(refusal(R"({"lights": [{"type": "point", "scatter": {"count": 4000000000, "box": "bounds"}}]})",
                  ErrorKind::limit) ==
          "test.json: /lights/0: expected at most 1000 lights in the scene, got 4000000002");

    std::string triangles = "[0, 0, 0]";
    for (int i = 0; i < 16384; ++i) triangles += ", [0, 0, 0]";
    Scene walled = plainScene();
    try {
        applyRigText(walled,
                     R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": [)" + triangles +
                         "]}}]}",
                     "test.json");
        FAIL_CHECK("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::limit);
        CHECK(std::string(error.what()) ==
              "test.json: /lightVolumes/0/mesh/indices: expected at most 16384 triangles in a light volume, got 16385");
    }
    try {
        applyRigText(walled, R"({"lightVolumes": [{"name": "v", "object": "floor"}]})", "test.json",
                     LoadLimits{.maxVertices = 2});
        FAIL_CHECK("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::limit);
        CHECK(std::string(error.what()) ==
              "test.json: /lightVolumes/0/object: expected at most 2 vertices in the scene's light volumes, got 3");
    }

    Json functions = Json::array();
    for (int i = 0; i < 1025; ++i) functions.push_back({{"name", fmt::format("f{}", i)}, {"kind", "lambert"}});
    Scene scene = plainScene();
    try {
        applyRigText(scene, Json{{"functions", functions}}.dump(), "test.json");
        FAIL_CHECK("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::limit);
        CHECK(std::string(error.what()) ==
              "test.json: /functions/1024: expected at most 1024 functions in the scene, got 1025");
    }
}

TEST_CASE("rig: every prefix of a rig is refused, and so is any value of a wrong type") {
    const std::string text = kFullRig;
    for (size_t length = 0; length < text.size(); ++length) {
        Scene scene;
        CHECK_THROWS_AS(applyRigText(scene, text.substr(0, length), "test.json"), Error);
    }
    const Json whole = Json::parse(text);
    const Json flat = whole.flatten();
    size_t tried = 0;
    for (const auto& [pointer, before] : flat.items()) {
        for (const Json& wrong :
             {Json(), Json(true), Json(Json::object()), Json("?"), Json(-7.5), Json::array({Json::array()})}) {
            Json changed = whole;
            changed[Json::json_pointer(pointer)] = wrong;
            Scene scene = plainScene();
            try {
                applyRigText(scene, changed.dump(), "test.json");
            } catch (const Error& error) {
                CHECK(std::string(error.what()).starts_with("test.json: /"));
            }
            ++tried;
        }
    }
    CHECK(tried > 600);
}
