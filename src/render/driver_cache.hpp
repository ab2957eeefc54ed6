#pragma once
#include <filesystem>
#include <map>
#include <string>

#include <luciole/renderer.hpp>

namespace luciole::render {

/// What was found out about a device and its driver, kept from one start to the next: values by key, in a file of its own for each
/// driver. Nothing depends on the file: one that is damaged, another device's or another version's is as good as none, and where none
/// can be written the next start finds out again.
///
///     luciole WHAT VERSION <tab> DEVICE <tab> DRIVER
///     KEY <tab> VALUE                                    any number of them, sorted
///     check <tab> FNV-1a hash of all that stands before, 16 hexadecimal digits
class DriverCache {
public:
    /// \param folder empty: nothing is kept
    /// \param version of what the values mean
    DriverCache(const std::string& folder, const std::string& what, uint32_t version, const DeviceInfo& device);

    /// The value of a key; null if there is none.
    const std::string* find(const std::string& key) const;
    /// Keeps a value, from now on and for the next start. \param key, value without tabs and line ends
    void keep(const std::string& key, const std::string& value);

private:
    void load();
    void save() const;

    std::string header_;
    std::filesystem::path file_;  ///< empty: none
    std::map<std::string, std::string> values_;
};

}  // namespace luciole::render
