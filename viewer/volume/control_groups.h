#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace volumen {

/// Returns the folders of the control groups that limit this process by `controller` ("memory", "cpu"): from
/// the group visible here as the root down to its own. Version 1 and version 2 are asked for apart. `root` is
/// "/" but for tests.
std::vector<std::filesystem::path> controlGroups(const std::filesystem::path& root,
                                                 const std::string& controller, bool version2);

/// Returns the number of threads that the CPU quotas of control groups (versions 1 and 2, including parents)
/// allow, at least 1; a large number without a quota.
int threadsOfControlGroups(const std::filesystem::path& root = "/");

}  // namespace volumen
