#include "render/driver_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <luciole/output.hpp>
#include <optional>

#include "hash.hpp"

namespace luciole::render {
namespace {

constexpr uint64_t kLargestFile = 1 << 20;  // bytes; ours have some thousand
constexpr std::string_view kCheck = "check\t";

std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < ' '; }, ' ');
    return text;
}

/// All of the file; nothing if it can't be read or is none of ours by its size.
std::string contentOf(const std::filesystem::path& file) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed) || std::filesystem::file_size(file, failed) > kLargestFile) return "";
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The text before the check, if the check is right.
std::optional<std::string_view> checked(std::string_view text) {
    const size_t check = text.rfind(kCheck);
    if (check == std::string_view::npos) return std::nullopt;
    const std::string_view body = text.substr(0, check);
    if (text.substr(check) != fmt::format("{}{:016x}\n", kCheck, Hash().add(body).value())) return std::nullopt;
    return body;
}

}  // namespace

DriverCache::DriverCache(const std::string& folder, const std::string& what, uint32_t version, const DeviceInfo& device)
    : header_(fmt::format("luciole {} {}\t{}\t{}", what, version, printable(device.name), printable(device.driver))) {
    if (folder.empty()) return;
    // By name and version: Mesa's software driver (22.3) has one UUID for all of its versions.
    std::string name = what + " " + device.name + " " + device.driver;
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c) && c != '.'; }, '-');
    file_ = std::filesystem::path(folder) / name.substr(0, 200);
    load();
}

const std::string* DriverCache::find(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : &found->second;
}

void DriverCache::keep(const std::string& key, const std::string& value) {
    values_[key] = value;
    if (!file_.empty()) save();
}

void DriverCache::load() {
    const std::string text = contentOf(file_);
    std::optional<std::string_view> rest = checked(text);
    if (!rest) return;
    for (bool first = true; !rest->empty(); first = false) {
        const std::string_view line = rest->substr(0, rest->find('\n'));
        rest->remove_prefix(std::min(line.size() + 1, rest->size()));
        if (first && line != header_) return;
        const size_t tab = line.find('\t');
        if (!first && tab != std::string_view::npos) values_.emplace(line.substr(0, tab), line.substr(tab + 1));
    }
}

void DriverCache::save() const {
    std::string text = header_ + "\n";
    for (const auto& [key, value] : values_) text += fmt::format("{}\t{}\n", key, value);
    text += fmt::format("{}{:016x}\n", kCheck, Hash().add(text).value());
    try {
        std::filesystem::create_directories(file_.parent_path());
        writeFileAtomically(file_, std::as_bytes(std::span(text)));
    } catch (const std::exception&) {  // the next start finds out again
    }
}

}  // namespace luciole::render
