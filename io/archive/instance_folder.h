#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "io/archive/association.h"

namespace volumen {

/// A folder of instances. Each appears whole, under a name made of its UID, or not at all.
class InstanceFolder : public InstanceSink {
 public:
  /// `folder` must exist. `onStored` is called after each instance.
  explicit InstanceFolder(std::string folder, std::function<void()> onStored = {});
  ~InstanceFolder() override;

  std::string pathOf(const std::string& sopInstanceUid) const;
  bool has(const std::string& sopInstanceUid) const;
  std::uint64_t bytesWritten() const { return bytes_; }

  Result<std::string> begin(const std::string& sopInstanceUid) override;
  Status end(const std::string& sopInstanceUid, const std::string& path) override;
  void drop(const std::string& path) override;

 private:
  const std::string folder_;
  const std::function<void()> onStored_;
  std::map<std::string, int> open_;  ///< files being written, and their locked descriptors
  std::uint64_t bytes_ = 0;
};

}  // namespace volumen
