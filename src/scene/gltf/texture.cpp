#include <cmath>

#include "io/image_codec.hpp"
#include "scene/gltf/material.hpp"

namespace luciole::gltf {

namespace {

/// Codes of glTF 2.0, section 5.26, which are OpenGL's.
Wrap wrapOf(const JsonNode& sampler, std::string_view key) {
    switch (integerOr(sampler, key, 10497, 0, 65535)) {
        case 10497:
            return Wrap::repeat;
        case 33071:
            return Wrap::clampToEdge;
        case 33648:
            return Wrap::mirroredRepeat;
        default:
            sampler.at(key).fail("10497, 33071 or 33648");
    }
}

Sampler samplerOf(const JsonNode& json) {
    Sampler sampler{.wrapU = wrapOf(json, "wrapS"), .wrapV = wrapOf(json, "wrapT")};
    if (const auto mag = json.find("magFilter")) {
        sampler.magFilter = mag->integer(9728, 9729) == 9728 ? Filter::nearest : Filter::linear;
    }
    const auto min = json.find("minFilter");
    if (!min) return sampler;
    const uint64_t code = min->integer(9728, 9987);
    if (code > 9729 && code < 9984) min->fail("9728, 9729 or 9984 to 9987");
    sampler.minFilter = code % 2 == 0 ? Filter::nearest : Filter::linear;
    sampler.mipFilter = code <= 9729 ? MipFilter::none : code <= 9985 ? MipFilter::nearest : MipFilter::linear;
    return sampler;
}

/// The extension's text, with v running down the picture: a counter-clockwise turn of the UVs. The GLSL in the
/// extension's README turns them the other way; its worked example (a quadrant turned by 90 degrees), its text and the
/// Khronos test model agree with this one.
std::array<vec3, 2> uvTransformOf(const JsonNode& json) {
    const dvec2 offset = vectorOr<2>(json, "offset", dvec2(0));
    const dvec2 scale = vectorOr<2>(json, "scale", dvec2(1));
    const double angle = numberOr(json, "rotation", 0);
    const double c = std::cos(angle), s = std::sin(angle);
    return {vec3(c * scale.x, s * scale.y, offset.x), vec3(-s * scale.x, c * scale.y, offset.y)};
}

}  // namespace

TextureUse Textures::load(const JsonNode& info) {
    TextureUse use;
    uint64_t uvSet = integerOr(info, "texCoord", 0, 0, kNone);
    if (const auto transform = extension(info, "KHR_texture_transform")) {
        use.uvTransform = uvTransformOf(*transform);
        uvSet = integerOr(*transform, "texCoord", uvSet, 0, kNone);
    }
    if (uvSet > 1) {
        warnings_.add(fmt::format("{}: UV set {} is not supported; the texture is left out", info.path(), uvSet));
        return {};
    }
    use.uvSet = uint32_t(uvSet);
    use.texture = loadTexture(info.at("index"));
    return use;
}

uint32_t Textures::loadTexture(const JsonNode& reference) {
    const uint32_t index = indexInto(root_, "textures", reference);
    if (const auto known = textures_.find(index); known != textures_.end()) return known->second;
    const JsonNode json = root_.at("textures")[index];
    const auto source = json.find("source");
    if (!source) {
        warnings_.add(fmt::format("{}: has no image that can be read; left out", json.path()));
        return textures_[index] = kNone;
    }
    Texture texture;
    texture.texels = loadTexels(*source);
    if (const auto sampler = json.find("sampler")) texture.sampler = samplerOf(resolve(root_, "samplers", *sampler));
    scene_.textures.push_back(texture);
    return textures_[index] = uint32_t(scene_.textures.size() - 1);
}

uint32_t Textures::loadTexels(const JsonNode& reference) {
    const uint32_t index = indexInto(root_, "images", reference);
    if (const auto known = texels_.find(index); known != texels_.end()) return known->second;
    scene_.texels.push_back(decode(root_.at("images")[index]));
    decodedBytes_ += scene_.texels.back().rgba.size();
    return texels_[index] = uint32_t(scene_.texels.size() - 1);
}

Texels Textures::decode(const JsonNode& image) {
    const auto decodeBytes = [&](std::span<const std::byte> bytes, const JsonNode& source,
                                 const std::string& fallback) {
        Rgba8 rgba = decodeImage(bytes, source.where(), limits_.maxImageSide, limits_.maxImageBytes - decodedBytes_);
        return Texels{stringOr(image, "name", fallback), rgba.width, rgba.height, std::move(rgba.texels)};
    };
    const auto uri = image.find("uri");
    if (!uri) {
        const JsonNode reference = image.at("bufferView");
        return decodeBytes(buffers_.view(reference).bytes, reference, image.path());
    }
    if (isDataUri(*uri)) return decodeBytes(decodeDataUri(*uri), *uri, image.path());
    const std::filesystem::path file = files_.resolve(*uri);
    return decodeBytes(files_.read(file, *uri), *uri, file.filename().string());
}

}  // namespace luciole::gltf
