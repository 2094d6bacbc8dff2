#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/archive/instance_sink.h"
#include "io/files/output_file.h"

namespace volumen {

/// A folder of the instances of one series. Each appears whole, under a name made of its UID, or not at all.
class InstanceFolder : public InstanceSink {
 public:
  /// `folder` must exist. It takes `most` instances from `archive`, a name, whether it keeps them or not.
  /// `onStored` is called after each that it keeps.
  InstanceFolder(std::string archive, std::string folder, std::string studyUid, std::string seriesUid,
                 std::size_t most, std::function<void()> onStored = {})
      : archive_(std::move(archive)),
        folder_(std::move(folder)),
        studyUid_(std::move(studyUid)),
        seriesUid_(std::move(seriesUid)),
        left_(most),
        onStored_(std::move(onStored)) {}

  std::uint64_t bytesWritten() const { return bytes_; }

  bool has(const std::string& sopInstanceUid) const override;
  Result<std::string> begin() override;
  Status end(const dicom::InstanceUids& uids) override;
  void drop() override { written_.reset(); }

 private:
  std::string pathOf(const std::string& sopInstanceUid) const;

  const std::string archive_, folder_, studyUid_, seriesUid_;
  std::size_t left_;
  const std::function<void()> onStored_;
  std::optional<OutputFile> written_;
  std::uint64_t bytes_ = 0;
};

}  // namespace volumen
