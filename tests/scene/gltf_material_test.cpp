#include <cmath>

#include <doctest/doctest.h>

#include "gltf_document.hpp"
#include "io/image_codec.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

std::string pngUri(uint32_t width, uint32_t height, uint32_t channels, const std::vector<uint8_t>& samples) {
    return "data:image/png;base64," + base64(encodePng(width, height, channels, std::span<const uint8_t>(samples)));
}

Document withMaterial(const Json& material) {
    Document document;
    document.triangle();
    document.json["images"] = {{{"uri", pngUri(1, 1, 3, {255, 0, 0})}}, {{"uri", pngUri(1, 1, 3, {0, 255, 0})}}};
    document.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 0}}};
    document.json["materials"] = Json::array({material});
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    return document;
}

Document withImage(const Json& image) {
    Document document = withMaterial({{"emissiveTexture", {{"index", 0}}}});
    document.json["images"] = Json::array({image});
    return document;
}

Sampler samplerFrom(const Json& sampler) {
    Document document = withMaterial({{"emissiveTexture", {{"index", 0}}}});
    document.json["samplers"] = Json::array({sampler});
    document.json["textures"][0]["sampler"] = 0;
    return document.load().textures.at(0).sampler;
}

}  // namespace

TEST_CASE("glTF materials: a primitive without material gets glTF's default, once") {
    Document document;
    document.triangle();
    document.json["meshes"][0]["primitives"].push_back(document.json["meshes"][0]["primitives"][0]);
    const Scene scene = document.load();
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].baseColor == vec4(1));
    CHECK(scene.materials[0].metallic == 1);
    CHECK(scene.materials[0].roughness == 1);
    CHECK(scene.materials[0].alphaMode == AlphaMode::opaque);
}

TEST_CASE("glTF materials: all factors and all five textures arrive") {
    const Json pbr{{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                   {"metallicFactor", 0.5},
                   {"roughnessFactor", 0.6},
                   {"baseColorTexture", {{"index", 0}}},
                   {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}};
    const Scene scene = withMaterial({{"name", "full"},
                                      {"pbrMetallicRoughness", pbr},
                                      {"normalTexture", {{"index", 2}, {"scale", 0.7}}},
                                      {"occlusionTexture", {{"index", 1}, {"strength", 0.8}}},
                                      {"emissiveTexture", {{"index", 0}}},
                                      {"emissiveFactor", {1, 0.5, 0}},
                                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}},
                                      {"doubleSided", true}})
                            .load();
    const Material& m = scene.materials.at(0);
    CHECK(m.name == "full");
    CHECK(m.equation == LightEquation::metallicRoughness);
    CHECK(m.baseColor == vec4(0.1f, 0.2f, 0.3f, 0.4f));
    CHECK(m.metallic == 0.5f);
    CHECK(m.roughness == 0.6f);
    CHECK(m.normalScale == 0.7f);
    CHECK(m.occlusionStrength == 0.8f);
    CHECK(m.emissive == vec3(10, 5, 0));
    CHECK(m.doubleSided);
    CHECK(m.metallicRoughnessTexture.uvSet == 1);
    CHECK(m.occlusionTexture.uvSet == 0);
    CHECK(m.baseColorTexture.texture == m.emissiveTexture.texture);
    CHECK(m.metallicRoughnessTexture.texture == m.occlusionTexture.texture);
    REQUIRE(scene.textures.size() == 3);
    REQUIRE(scene.texels.size() == 2);  // two textures of one image
    CHECK(scene.textures[m.baseColorTexture.texture].texels == scene.textures[m.normalTexture.texture].texels);
    CHECK(scene.texels[scene.textures[m.occlusionTexture.texture].texels].rgba == std::vector<uint8_t>{0, 255, 0, 255});
}

TEST_CASE("glTF materials: MASK keeps its cutoff; BLEND blends, has none, and is no reason to warn") {
    Material m = withMaterial({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}}).load().materials.at(0);
    CHECK(m.alphaMode == AlphaMode::mask);
    CHECK(m.alphaCutoff == 0.25f);
    const Scene scene = withMaterial({{"name", "glass"}, {"alphaMode", "BLEND"}, {"alphaCutoff", 0.25}}).load();
    CHECK(scene.materials.at(0).alphaMode == AlphaMode::blend);
    CHECK(scene.materials.at(0).alphaCutoff == 0.5f);
    CHECK(scene.warnings.empty());
    CHECK(withMaterial({{"alphaMode", "ADD"}}).refusal().message ==
          "test.gltf: /materials/0/alphaMode: expected one of OPAQUE, MASK, BLEND, got \"ADD\"");
}

TEST_CASE("glTF materials: KHR_materials_unlit makes a material unlit") {
    Document document = withMaterial({{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    document.json["extensionsRequired"] = {"KHR_materials_unlit"};
    CHECK(document.load().materials.at(0).equation == LightEquation::unlit);
}

TEST_CASE("glTF materials: a factor outside of its range is refused") {
    CHECK(withMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 1.5}}}}).refusal().message ==
          "test.gltf: /materials/0/pbrMetallicRoughness/metallicFactor: expected a number in [0, 1], got 1.5");
    CHECK(withMaterial({{"emissiveFactor", {0, -1, 0}}}).refusal().message ==
          "test.gltf: /materials/0/emissiveFactor/1: expected a number >= 0, got -1");
}

TEST_CASE(
    "glTF textures: KHR_texture_transform scales, turns counter-clockwise, then moves, and overrides the UV set") {
    // The example of the extension's text: the lower left quadrant, turned by 90 degrees.
    const Json transform{{"offset", {0, 1}}, {"rotation", kPi / 2}, {"scale", {0.5, 0.5}}, {"texCoord", 1}};
    const Scene scene =
        withMaterial({{"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}})
            .load();
    const TextureUse& use = scene.materials.at(0).emissiveTexture;
    CHECK(use.uvSet == 1);
    const auto apply = [&](float u, float v) {
        return vec2(glm::dot(use.uvTransform[0], vec3(u, v, 1)), glm::dot(use.uvTransform[1], vec3(u, v, 1)));
    };
    const float rounding = 1e-6f;  // of pi / 2
    CHECK(glm::length(apply(0, 0) - vec2(0, 1)) < rounding);
    CHECK(glm::length(apply(1, 0) - vec2(0, 0.5f)) < rounding);
    CHECK(glm::length(apply(0, 1) - vec2(0.5f, 1)) < rounding);
}

TEST_CASE("glTF textures: without the extension UVs are used as they are; a third UV set is left out with a warning") {
    Scene scene = withMaterial({{"emissiveTexture", {{"index", 0}}}}).load();
    CHECK(scene.materials.at(0).emissiveTexture.uvTransform == std::array<vec3, 2>{vec3(1, 0, 0), vec3(0, 1, 0)});
    scene = withMaterial({{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}}).load();
    CHECK(scene.materials.at(0).emissiveTexture.texture == kNone);
    CHECK(scene.warnings.size() == 1);
}

TEST_CASE("glTF textures: samplers keep their wrap and filter modes") {
    CHECK(samplerFrom(Json::object()) == Sampler{});
    CHECK(samplerFrom({{"wrapS", 33071}, {"wrapT", 33648}}) ==
          Sampler{.wrapU = Wrap::clampToEdge, .wrapV = Wrap::mirroredRepeat});
    CHECK(samplerFrom({{"wrapS", 10497}, {"magFilter", 9728}}) == Sampler{.magFilter = Filter::nearest});
    CHECK(samplerFrom({{"magFilter", 9729}}) == Sampler{});
    const auto minified = [](Filter filter, MipFilter mips) { return Sampler{.minFilter = filter, .mipFilter = mips}; };
    CHECK(samplerFrom({{"minFilter", 9728}}) == minified(Filter::nearest, MipFilter::none));
    CHECK(samplerFrom({{"minFilter", 9729}}) == minified(Filter::linear, MipFilter::none));
    CHECK(samplerFrom({{"minFilter", 9984}}) == minified(Filter::nearest, MipFilter::nearest));
    CHECK(samplerFrom({{"minFilter", 9985}}) == minified(Filter::linear, MipFilter::nearest));
    CHECK(samplerFrom({{"minFilter", 9986}}) == minified(Filter::nearest, MipFilter::linear));
    CHECK(samplerFrom({{"minFilter", 9987}}) == minified(Filter::linear, MipFilter::linear));
    CHECK(refusalOf([] {
              samplerFrom({{"wrapS", 1}});
          }).message == "test.gltf: /samplers/0/wrapS: expected 10497, 33071 or 33648, got 1");
    CHECK(refusalOf([] {
              samplerFrom({{"minFilter", 9800}});
          }).message == "test.gltf: /samplers/0/minFilter: expected 9728, 9729 or 9984 to 9987, got 9800");
}

TEST_CASE("glTF images: PNG of 1, 3 and 4 channels decodes to RGBA, from a data URI or a buffer view") {
    CHECK(withImage({{"uri", pngUri(2, 1, 1, {7, 9})}}).load().texels.at(0).rgba ==
          std::vector<uint8_t>{7, 7, 7, 255, 9, 9, 9, 255});
    CHECK(withImage({{"uri", pngUri(1, 2, 4, {1, 2, 3, 4, 5, 6, 7, 8})}}).load().texels.at(0).rgba ==
          std::vector<uint8_t>{1, 2, 3, 4, 5, 6, 7, 8});

    Document document = withImage({{"name", "pixel"}, {"bufferView", 1}, {"mimeType", "image/png"}});
    const std::vector<uint8_t> samples{10, 20, 30};
    const std::vector<std::byte> png = encodePng(1, 1, 3, std::span<const uint8_t>(samples));
    document.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", document.add(png)}, {"byteLength", png.size()}});
    const Scene scene = document.load();
    CHECK(scene.texels.at(0).name == "pixel");
    CHECK(scene.texels.at(0).rgba == std::vector<uint8_t>{10, 20, 30, 255});
}

TEST_CASE("glTF images: 16-bit PNG keeps its high bytes") {
    const std::vector<uint16_t> samples{0x1234, 0x5678, 0xffff};
    const auto png = encodePng(1, 1, 3, std::span<const uint16_t>(samples));
    const Scene scene = withImage({{"uri", "data:image/png;base64," + base64(png)}}).load();
    CHECK(scene.texels.at(0).rgba == std::vector<uint8_t>{0x12, 0x56, 0xff, 255});
}

TEST_CASE("glTF images: JPEG decodes to its colour within a step or two of its rounding") {
    const std::string jpeg =
        "data:image/jpeg;base64,/9j/4AAQSkZJRgABAQAAAQABAAD/"
        "2wBDAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQH/"
        "2wBDAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQH/"
        "wAARCAAIAAgDAREAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/"
        "8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkd"
        "ISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4"
        "+Tl5ufo6erx8vP09fb3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/"
        "8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKRobHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZ"
        "HSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4"
        "uPk5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEAPwDn6/yvP9sD/9k=";
    const Scene scene = withImage({{"uri", jpeg}}).load();
    const Texels& texels = scene.texels.at(0);
    CHECK(texels.width == 8);
    CHECK(texels.height == 8);
    REQUIRE(texels.rgba.size() == 8 * 8 * 4);
    const int expected[]{200, 100, 50, 255};
    for (size_t i = 0; i < texels.rgba.size(); ++i) CHECK(std::abs(texels.rgba[i] - expected[i % 4]) <= 2);

    const Refusal cut = withImage({{"uri", jpeg.substr(0, jpeg.size() - 24)}}).refusal();
    CHECK(cut.kind == ErrorKind::scene);
    CHECK(cut.message.starts_with("test.gltf: /images/0/uri: expected a JPEG picture: "));
}

TEST_CASE("glTF images: one that nothing uses is not even looked at") {
    Document document = withMaterial(Json::object());
    document.json["images"].push_back({{"uri", "data:image/png;base64,AAAA"}});
    document.json["textures"].push_back({{"source", 2}});
    CHECK(document.load().texels.empty());
}

TEST_CASE("glTF images: unknown signatures and broken or cut files are refused with their path") {
    const Refusal unknown = withImage({{"uri", "data:image/webp;base64,UklGRgAA"}}).refusal();
    CHECK(unknown.kind == ErrorKind::scene);
    CHECK(unknown.message == "test.gltf: /images/0/uri: expected a PNG or JPEG picture, got neither's signature");
    const std::string png = pngUri(4, 4, 3, std::vector<uint8_t>(48, 9));
    const Refusal cut = withImage({{"uri", png.substr(0, png.size() - 24)}}).refusal();
    CHECK(cut.kind == ErrorKind::scene);
    CHECK(cut.message.starts_with("test.gltf: /images/0/uri: expected a PNG picture: "));
}

TEST_CASE("glTF images: a side or a sum of bytes beyond the limits is refused before it is allocated") {
    Document document = withImage({{"uri", pngUri(4, 2, 3, std::vector<uint8_t>(24, 9))}});
    LoadOptions options;
    options.limits.maxImageSide = 3;
    CHECK(document.refusal(options).kind == ErrorKind::limit);
    CHECK(document.refusal(options).message == "test.gltf: /images/0/uri: expected at most 3 texels a side, got 4 x 2");

    options.limits = {};
    options.limits.maxImageBytes = 7;  // two images of four bytes each
    const Json first{{"index", 0}}, second{{"index", 1}};
    CHECK(withMaterial({{"emissiveTexture", first}}).refusal(options).message == "loaded");
    CHECK(withMaterial({{"emissiveTexture", first}, {"occlusionTexture", second}}).refusal(options).message ==
          "test.gltf: /images/0/uri: expected at most 3 bytes decoded, got 1 x 1 x 4");
}

TEST_CASE("glTF images: a header that promises more than the data can hold is refused") {
    // The size in the header of a 1 x 1 picture, replaced; its checksum as well.
    const std::vector<uint8_t> samples{1, 2, 3};
    std::vector<std::byte> png = encodePng(1, 1, 3, std::span<const uint8_t>(samples));
    const uint8_t size[]{0, 0, 0x40, 0, 0, 0, 0x40, 0, 8, 2, 0, 0, 0};
    uint32_t crc = ~0u;
    const auto feed = [&crc](uint8_t byte) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    };
    for (const char c : {'I', 'H', 'D', 'R'}) feed(uint8_t(c));
    for (size_t i = 0; i < sizeof(size); ++i) {
        png[16 + i] = std::byte(size[i]);
        feed(size[i]);
    }
    for (int i = 0; i < 4; ++i) png[size_t(29 + i)] = std::byte(~crc >> (24 - 8 * i) & 0xff);
    const Refusal refusal = withImage({{"uri", "data:image/png;base64," + base64(png)}}).refusal();
    CHECK(refusal.kind == ErrorKind::scene);
    CHECK(refusal.message.find("for the size it claims") != std::string::npos);
}
