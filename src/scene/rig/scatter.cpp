#include "scene/rig/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

float largest(vec3 v) { return std::max({v.r, v.g, v.b}); }

/// Smith 1978, "Color Gamut Transform Pairs", HSV to RGB with value 1; `hue` in degrees, in linear light.
vec3 colorOfHue(double hue, double saturation) {
    const auto channel = [&](double offset) {
        const double k = glm::mod(offset + hue / 60, 6.0);
        return 1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    };
    return vec3(channel(5), channel(3), channel(1));
}

}  // namespace

void recolor(Light& light, const std::optional<vec3>& color, const std::optional<double>& intensity,
             const JsonNode& source) {
    if (!color && !intensity) return;
    const float before = largest(light.color);
    const vec3 hue = color ? *color : before > 0 ? light.color / before : vec3(1);
    light.color = hue * (intensity ? float(*intensity) : before);
    if (!(largest(light.color) <= float(JsonNode::kMost))) {
        source.failWith("expected color times intensity to fit into 32 bits, got more");
    }
}

Scatter::Scatter(const JsonNode& node, const Scene& scene)
    : node_(node),
      count_(uint32_t(node.at("count").integer(1, 0xFFFFFFFF))),
      random_(node.find("seed") ? node.at("seed").integer(0, ~uint64_t(0)) : 1),
      onLine_(node.find("line").has_value()) {
    node.expectKeys({"count", "seed", "box", "line", "jitter", "colors", "hue", "saturation", "intensity", "range"});
    if (onLine_) {
        const JsonNode line = node.at("line");
        if (const auto box = node.find("box")) box->failWith("expected either a box or a line, got both");
        line.expectKeys({"from", "to"});
        low_ = line.at("from").vector3();
        high_ = line.at("to").vector3();
    } else if (const JsonNode box = node.at("box"); box.isString()) {
        box.choice({"bounds"});
        const Bounds bounds = boundsOf(scene);
        low_ = bounds.low;
        high_ = bounds.high;
    } else {
        box.expectKeys({"low", "high"});
        low_ = box.at("low").vector3();
        high_ = box.at("high").vector3();
    }
    if (const auto v = node.find("jitter")) jitter_ = v->number(0);
    if (const auto v = node.find("colors")) {
        if (v->size() == 0) v->fail("at least one colour");
        for (const JsonNode& one : v->elements()) palette_.push_back(color(one));
    }
    if (const auto v = node.find("hue")) {
        if (!palette_.empty()) v->failWith("expected either colors or a hue, got both");
        hue_ = interval(*v, -360, 720);
    }
    if (const auto v = node.find("saturation")) {
        if (!hue_) v->failWith("saturation needs a hue");
        saturation_ = v->number(0, 1);
    }
    if (const auto v = node.find("intensity")) intensity_ = interval(*v, 0, JsonNode::kMost);
    if (const auto v = node.find("range"))
        range_ = interval(*v, double(std::numeric_limits<float>::min()), JsonNode::kMost);
}

vec3 Scatter::place(uint32_t index) {
    dvec3 position;
    if (onLine_) {
        const double t = count_ > 1 ? double(index) / (count_ - 1) : 0.5;
        position = glm::mix(low_, high_, t);
    } else {
        for (int axis = 0; axis < 3; ++axis) position[axis] = random_.between(low_[axis], high_[axis]);
    }
    if (jitter_ > 0) {
        for (int axis = 0; axis < 3; ++axis) position[axis] += random_.between(-jitter_, jitter_);
    }
    return vec3(position);
}

vec3 Scatter::pickColor() {
    if (hue_) return colorOfHue(random_.between(hue_->x, hue_->y), saturation_);
    return palette_[random_.below(uint32_t(palette_.size()))];
}

void Scatter::vary(Light& light) {
    std::optional<vec3> newColor;
    std::optional<double> newIntensity;
    if (hue_ || !palette_.empty()) newColor = pickColor();
    if (intensity_) newIntensity = random_.between(intensity_->x, intensity_->y);
    recolor(light, newColor, newIntensity, node_);
    if (range_) light.range = float(random_.between(range_->x, range_->y));
}

}  // namespace luciole::rig
