// Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images": section 4.1 compares filtered colours, 4.2 edges and
// points, 4.3 joins both. Its filters are Gaussians and their derivatives, so that each is a pass along rows and one along columns.
#include "metrics/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <luciole/math.hpp>
#include <luciole/metrics.hpp>
#include <span>

#include "metrics/convolution.hpp"
#include "metrics/shape.hpp"
#include "parallel/parallel_rows.hpp"

namespace luciole {
namespace metrics {
namespace {

/// XYZ relative to white, which is (1, 1, 1). Primaries of Rec. 709 with D65 as the authors' program has it.
mat3 relativeXyzFromRgb() {
    const dmat3 primaries(0.64, 0.33, 0.03, 0.30, 0.60, 0.10, 0.15, 0.06, 0.79);
    const dvec3 white = dvec3(0.31271, 0.32902, 0.35827) / 0.32902;
    const dvec3 amounts = glm::inverse(primaries) * white;
    dmat3 matrix;
    for (int c = 0; c < 3; ++c) matrix[c] = amounts[c] * primaries[c] / white;
    return mat3(matrix);
}
const mat3 kXyzFromRgb = relativeXyzFromRgb();
const mat3 kRgbFromXyz = mat3(glm::inverse(dmat3(kXyzFromRgb)));

/// Lightness, red against green, yellow against blue: YCxCz of relative XYZ, CIELAB of their `labResponse`.
vec3 opponentFrom(vec3 xyz) { return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)}; }
vec3 xyzFrom(vec3 opponent) {
    const float y = (opponent.x + 16) / 116;
    return {y + opponent.y / 500, y, y - opponent.z / 200};
}

/// CIE 15:2004, eq. 8.6 to 8.11.
float labResponse(float t) {
    constexpr float delta = 6.0f / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
}

/// CIELAB with the Hunt effect: colours of dark surfaces are less colourful.
vec3 huntAdjustedLab(vec3 rgb) {
    const vec3 xyz = kXyzFromRgb * rgb;
    const vec3 lab = opponentFrom({labResponse(xyz.x), labResponse(xyz.y), labResponse(xyz.z)});
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// Abasi, Tehran and Fairchild 2020, "Distance metrics for very large color differences".
float hyAb(vec3 a, vec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// A distance on [0, 1], the small ones spread over most of it.
float redistributed(float distance) {
    constexpr float qc = 0.7f, pc = 0.4f, pt = 0.95f;
    static const float cMax = std::pow(hyAb(huntAdjustedLab({0, 1, 0}), huntAdjustedLab({0, 0, 1})), qc);  // the farthest two colours
    const float c = std::pow(distance, qc);
    return c < pc * cMax ? pt / (pc * cMax) * c : std::min(pt + (1 - pt) * (c - pc * cMax) / (cMax - pc * cMax), 1.0f);
}

/// A term of a contrast sensitivity function in space: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
    double a, b;
};
constexpr std::array kAchromatic{Sensitivity{1, 0.0047}};
constexpr std::array kRedGreen{Sensitivity{1, 0.0053}};
constexpr std::array kBlueYellow{Sensitivity{34.1, 0.04}, Sensitivity{13.5, 0.025}};
constexpr double kWidestB = 0.04;

/// The plane as an observer sees it; the terms together weigh 1.
Image filtered(const Image& plane, std::span<const Sensitivity> terms, double pixelsPerDegree) {
    const auto sigma = [&](double b) { return pixelsPerDegree * std::sqrt(b / 2) / kPi; };
    const int radius = int(std::ceil(3 * sigma(kWidestB)));
    Image result(plane.width, plane.height, 1);
    double sum = 0;
    for (const auto& [a, b] : terms) {
        const Kernel kernel = gaussian(sigma(b), radius);
        const double centre = kernel[size_t(radius)];  // what it was divided by to sum to 1, inverted
        const double weight = a * std::sqrt(kPi / b) / (centre * centre);
        const Image part = convolve(plane, kernel, kernel);
        sum += weight;
        for (size_t i = 0; i < result.data.size(); ++i) result.data[i] += float(weight / sum) * (part.data[i] - result.data[i]);
    }
    return result;
}

/// A derivative of a Gaussian; its positive weights sum to 1, its negative ones to -1. \param order 1 finds edges, 2 points
Kernel derivative(int order, double sigma, int radius) {
    Kernel kernel;
    double positive = 0, negative = 0;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * sigma * sigma));
        const double weight = order == 1 ? -x * g : (x * x / (sigma * sigma) - 1) * g;
        (weight > 0 ? positive : negative) += std::abs(weight);
        kernel.push_back(float(weight));
    }
    for (float& weight : kernel) weight /= float(weight > 0 ? positive : negative);
    return kernel;
}

/// How much of a feature there is, whatever its direction.
Image features(const Image& luminance, int order, double pixelsPerDegree) {
    constexpr double w = 0.082;  // degrees, between the peak and the trough of what finds edges
    const double sigma = 0.5 * w * pixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    const Kernel across = derivative(order, sigma, radius), along = gaussian(sigma, radius);
    Image magnitude = convolve(luminance, across, along);
    const Image alongY = convolve(luminance, along, across);
    for (size_t i = 0; i < magnitude.data.size(); ++i) magnitude.data[i] = std::hypot(magnitude.data[i], alongY.data[i]);
    return magnitude;
}

/// What is compared of a picture.
struct Perceived {
    std::array<Image, 3> opponent;  ///< YCxCz, filtered
    Image edges, points;

    vec3 color(size_t pixel) const {
        const vec3 filtered(opponent[0].data[pixel], opponent[1].data[pixel], opponent[2].data[pixel]);
        return huntAdjustedLab(glm::clamp(kRgbFromXyz * xyzFrom(filtered), 0.0f, 1.0f));
    }
};

Perceived perceive(const Image& linear, double pixelsPerDegree) {
    Image luminance(linear.width, linear.height, 1);
    std::array<Image, 3> opponent{luminance, luminance, luminance};
    for (size_t i = 0; i < luminance.data.size(); ++i) {
        const vec3 xyz = kXyzFromRgb * vec3(linear.data[3 * i], linear.data[3 * i + 1], linear.data[3 * i + 2]);
        const vec3 color = opponentFrom(xyz);
        luminance.data[i] = xyz.y;
        for (int c = 0; c < 3; ++c) opponent[size_t(c)].data[i] = color[c];
    }
    return {.opponent = {filtered(opponent[0], kAchromatic, pixelsPerDegree), filtered(opponent[1], kRedGreen, pixelsPerDegree),
                         filtered(opponent[2], kBlueYellow, pixelsPerDegree)},
            .edges = features(luminance, 1, pixelsPerDegree),
            .points = features(luminance, 2, pixelsPerDegree)};
}

}  // namespace

Image flipOfLinear(const Image& reference, const Image& test, double pixelsPerDegree) {
    constexpr float qf = 0.5f;
    const Perceived a = perceive(reference, pixelsPerDegree), b = perceive(test, pixelsPerDegree);
    Image errors(reference.width, reference.height, 1);
    const auto compareRow = [&](uint32_t y) {
        for (size_t i = size_t(y) * errors.width; i < size_t(y + 1) * errors.width; ++i) {
            const float colors = redistributed(hyAb(a.color(i), b.color(i)));
            const float edges = std::abs(a.edges.data[i] - b.edges.data[i]), points = std::abs(a.points.data[i] - b.points.data[i]);
            const float features = std::pow(std::max(edges, points) / std::sqrt(2.0f), qf);
            errors.data[i] = std::pow(colors, 1 - std::min(features, 1.0f));
        }
    };
    forEachRow(errors.height, compareRow, {});
    return errors;
}

Image linearFromDisplay(const Image& display) {
    Image linear = display;
    for (size_t i = 0; i < linear.data.size(); ++i) {
        float& x = linear.data[i];
        if (i % display.channels < 3) x = x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
    }
    return linear;
}

}  // namespace metrics

Image flip(const Image& reference, const Image& test, double pixelsPerDegree) {
    metrics::requireSameShape("FLIP", reference, test, 3);
    return metrics::flipOfLinear(metrics::linearFromDisplay(reference), metrics::linearFromDisplay(test), pixelsPerDegree);
}

}  // namespace luciole
