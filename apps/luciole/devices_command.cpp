#include <fmt/format.h>

#include <luciole/renderer.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "console.hpp"

namespace luciole::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string devicesJson(const std::vector<DeviceInfo>& devices) {
    Json json = Json::array();
    for (const DeviceInfo& device : devices)
        json.push_back({{"name", device.name},
                        {"driver", device.driver},
                        {"apiVersion", device.apiVersion},
                        {"software", device.software},
                        {"usable", device.usable},
                        {"whyUnusable", device.whyUnusable}});
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string devicesText(const std::vector<DeviceInfo>& devices) {
    std::string text;
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        text += fmt::format("{:>3}  {}{}\n     {}, Vulkan {}\n", i, device.name, device.software ? " (software)" : "",
                            device.driver, device.apiVersion);
        if (!device.usable) text += fmt::format("     not usable: {}\n", device.whyUnusable);
    }
    return text;
}

void run(bool json) {
    const std::vector<DeviceInfo> devices = listDevices();
    if (devices.empty()) say("luciole: no Vulkan device found; is a driver installed?\n");
    fmt::print("{}", json ? devicesJson(devices) + "\n" : devicesText(devices));
}

}  // namespace

void addDevicesCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "list the Vulkan devices of this machine");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print JSON");
    command->callback([json] { run(*json); });
}

}  // namespace luciole::cli
