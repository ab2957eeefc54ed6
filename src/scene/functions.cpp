#include <algorithm>
#include <cmath>

#include <luciole/scene.hpp>

namespace luciole {
namespace {

/// Oren and Nayar 1994, "Generalization of Lambert's Reflectance Model", eq. 30 without its last term, averaged over
/// all directions to the eye with their cosine as weight, times the cosine of incidence. Worked out in
/// docs/conventions.md; written here with `cos t tan t = sin t`, so that grazing incidence needs no division.
double orenNayar(double cosT, double sigma) {
    if (cosT <= 0) return 0;
    const double s2 = sigma * sigma;
    const double a = 1 - 0.5 * s2 / (s2 + 0.33);
    const double b = 0.45 * s2 / (s2 + 0.09);
    const double t = std::acos(cosT);
    const double sinT = std::sin(t);
    const double viewsAbove = cosT * sinT * (t / 2 - std::sin(2 * t) / 4);  // theta_r < theta_i
    const double viewsBelow = sinT * (1 - sinT * sinT * sinT) / 3;          // theta_r > theta_i
    return a * cosT + 2 * b / kPi * (viewsAbove + viewsBelow);
}

dvec2 interpolate(const std::vector<vec2>& samples, double x, double low) {
    if (samples.empty()) return dvec2(0);
    const double at = (x - low) / (1 - low) * double(samples.size() - 1);
    const size_t left = std::min(size_t(at), samples.size() - 1);
    const size_t right = std::min(left + 1, samples.size() - 1);
    return glm::mix(dvec2(samples[left]), dvec2(samples[right]), at - double(left));
}

}  // namespace

dvec2 evaluate(const Function& function, double x, double low) {
    x = x > low ? std::min(x, 1.0) : low;  // NaN becomes `low`
    const double positive = std::max(x, 0.0);
    const double lit = x > 0 ? 1 : 0;
    const double p = double(function.parameter);
    switch (function.kind) {
        case Function::Kind::lambert:
            return {positive, lit};
        case Function::Kind::wrap: {
            const double shape = std::max((x + p) / (1 + p), 0.0);
            return {shape, shape > 0 ? 1 : 0};
        }
        case Function::Kind::orenNayar:
            return {orenNayar(x, p), lit};
        case Function::Kind::blinnPhong:
            return {std::pow(positive, p), lit};
        case Function::Kind::constant:
            return {p, positive};
        case Function::Kind::toon:
            return {std::ceil(p * positive) / p, lit};
        case Function::Kind::sampled:
            return interpolate(function.samples, x, low);
    }
    return dvec2(0);
}

}  // namespace luciole
