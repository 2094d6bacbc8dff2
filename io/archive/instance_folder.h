#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/archive/instance_sink.h"
#include "io/files/output_file.h"

namespace volumen {

/// A folder of instances. Each appears whole, under a name made of its UID, or not at all.
class InstanceFolder : public InstanceSink {
 public:
  /// `folder` must exist. `onStored` is called after each instance.
  explicit InstanceFolder(std::string folder, std::function<void()> onStored = {})
      : folder_(std::move(folder)), onStored_(std::move(onStored)) {}

  std::uint64_t bytesWritten() const { return bytes_; }

  bool has(const std::string& sopInstanceUid) const override;
  Result<std::string> begin() override;
  Status end(const std::string& sopInstanceUid) override;
  void drop() override { written_.reset(); }

 private:
  std::string pathOf(const std::string& sopInstanceUid) const;

  const std::string folder_;
  const std::function<void()> onStored_;
  std::optional<OutputFile> written_;
  std::uint64_t bytes_ = 0;
};

}  // namespace volumen
