#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Stores headers of many files in little memory: each as its differences from one header of its series.
class PackedHeaders {
 public:
  void add(const FileHeader& header);
  std::size_t size() const { return packed_.size(); }
  /// Returns the header that was added as number `n`, from 0.
  FileHeader at(std::size_t n) const;
  /// Returns the bytes held, without the overhead of the allocator.
  std::size_t bytes() const { return bytes_; }

 private:
  using OwnBytes = std::vector<std::uint8_t>;
  struct Packed {
    std::uint32_t base = 0;                   ///< index in `bases_`
    OwnBytes others;                          ///< differences from that base
    std::shared_ptr<const FileHeader> whole;  ///< set if the bytes cannot be read back
  };

  std::map<std::pair<std::string, std::size_t>, std::uint32_t>
      baseOf_;  ///< keys: series UID and number of bytes
  std::vector<OwnBytes> bases_;
  std::vector<Packed> packed_;
  std::size_t bytes_ = 0;
};

}  // namespace volumen::dicom
