#include "reference/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/mip_chain.hpp"

namespace luciole::reference {
namespace {

double srgbToLinear(uint8_t byte) {
    static const auto table = [] {
        std::array<double, 256> values{};
        for (size_t i = 0; i < 256; ++i) values[i] = srgbByteToLinear(uint8_t(i));
        return values;
    }();
    return table[byte];
}

/// Brings a coordinate so near to [0, 1] that texel indices fit an integer; changes nothing that is seen.
double fold(double u, Wrap wrap) {
    if (!std::isfinite(u)) return 0;
    switch (wrap) {
        case Wrap::repeat:
            return u - std::floor(u);
        case Wrap::mirroredRepeat:
            return u - 2 * std::floor(u / 2);
        case Wrap::clampToEdge:
            return std::clamp(u, -1.0, 2.0);
    }
    return u;
}

int64_t wrapIndex(int64_t i, int64_t size, Wrap wrap) {
    const auto modulo = [](int64_t a, int64_t n) { return (a % n + n) % n; };
    switch (wrap) {
        case Wrap::repeat:
            return modulo(i, size);
        case Wrap::mirroredRepeat: {
            const int64_t along = modulo(i, 2 * size);
            return along < size ? along : 2 * size - 1 - along;
        }
        case Wrap::clampToEdge:
            return std::clamp<int64_t>(i, 0, size - 1);
    }
    return 0;
}

}  // namespace

SampledTexture::SampledTexture(Levels levels, const Sampler& sampler, bool srgb)
    : levels_(std::move(levels)), sampler_(sampler), srgb_(srgb) {}

double SampledTexture::levelOfDetail(dvec2 dx, dvec2 dy) const {
    const dvec2 size(levels_->front().width, levels_->front().height);
    return std::log2(std::max(length(dx * size), length(dy * size)));
}

dvec4 SampledTexture::sample(dvec2 uv, dvec2 dx, dvec2 dy) const {
    const double lambda = levelOfDetail(dx, dy);
    const dvec2 folded(fold(uv.x, sampler_.wrapU), fold(uv.y, sampler_.wrapV));
    if (lambda <= 0) return sampleLevel(0, folded, sampler_.magFilter);
    if (sampler_.mipFilter == MipFilter::none) return sampleLevel(0, folded, sampler_.minFilter);
    const size_t last = levels_->size() - 1;
    const double level = std::min(lambda, double(last));
    if (sampler_.mipFilter == MipFilter::nearest)
        return sampleLevel(size_t(std::ceil(level + 0.5)) - 1, folded, sampler_.minFilter);
    const auto finer = size_t(level);
    const dvec4 fine = sampleLevel(finer, folded, sampler_.minFilter);
    if (finer == last) return fine;
    return mix(fine, sampleLevel(finer + 1, folded, sampler_.minFilter), level - double(finer));
}

dvec4 SampledTexture::sampleLevel(size_t index, dvec2 uv, Filter filter) const {
    const Texels& level = (*levels_)[index];
    const dvec2 position = uv * dvec2(level.width, level.height);
    if (filter == Filter::nearest)
        return texel(level, int64_t(std::floor(position.x)), int64_t(std::floor(position.y)));
    const dvec2 corner = floor(position - 0.5);
    const dvec2 weight = position - 0.5 - corner;
    const auto x = int64_t(corner.x), y = int64_t(corner.y);
    return mix(mix(texel(level, x, y), texel(level, x + 1, y), weight.x),
               mix(texel(level, x, y + 1), texel(level, x + 1, y + 1), weight.x), weight.y);
}

dvec4 SampledTexture::texel(const Texels& level, int64_t x, int64_t y) const {
    const auto column = size_t(wrapIndex(x, level.width, sampler_.wrapU));
    const auto row = size_t(wrapIndex(y, level.height, sampler_.wrapV));
    const uint8_t* rgba = &level.rgba[(row * level.width + column) * 4];
    const double alpha = rgba[3] / 255.0;
    if (srgb_) return {srgbToLinear(rgba[0]), srgbToLinear(rgba[1]), srgbToLinear(rgba[2]), alpha};
    return {rgba[0] / 255.0, rgba[1] / 255.0, rgba[2] / 255.0, alpha};
}

}  // namespace luciole::reference
