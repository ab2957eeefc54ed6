#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "measure.hpp"

namespace luciole::bench {

/// A ratio of times that somebody published, and ours.
struct Ratio {
    std::string what;           ///< what is divided by what, and where
    std::string published;      ///< as published: a number or a range
    double measured = 0;        ///< ratio of the medians
    double low = 0, high = 0;   ///< what the medians' confidence intervals allow
    std::string whyNot;         ///< why it could not be measured; else empty
};

/// A published comparison of techniques, measured again on a scene as near to its own as a built-in one can be.
struct Reproduction {
    std::string_view name;
    std::string_view source;  ///< author, year, title
    std::string_view differs; ///< in what the set-up is another one
    std::vector<Ratio> (*run)(Renderer& renderer, uvec2 extent, const Effort& effort, const std::function<void(double)>& progress);
};
const std::vector<Reproduction>& reproductions();

}  // namespace luciole::bench
