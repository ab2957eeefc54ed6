#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace luciole::gltf {

/// Lines for Scene::warnings; one that repeats is kept once.
class Warnings {
public:
    explicit Warnings(std::vector<std::string>& lines) : lines_(lines) {}

    void add(std::string line) {
        if (seen_.insert(line).second) lines_.push_back(std::move(line));
    }

private:
    std::vector<std::string>& lines_;
    std::set<std::string> seen_;
};

}  // namespace luciole::gltf
