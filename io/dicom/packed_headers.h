#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Headers of many files in little memory: what the files of a series say alike is kept once.
class PackedHeaders {
 public:
  void add(const FileHeader& header);
  std::size_t size() const { return packed_.size(); }
  /// The header that was added as number `n`.
  FileHeader at(std::size_t n) const;
  /// What it takes, without what the allocator adds.
  std::size_t bytes() const { return bytes_; }

 private:
  using OwnBytes = std::vector<std::uint8_t>;
  struct Packed {
    std::uint32_t base = 0;                   ///< number of the header, in bytes, that it is like
    OwnBytes others;                          ///< where it differs from that
    std::shared_ptr<const FileHeader> whole;  ///< where bytes cannot hold it
  };

  std::map<std::pair<std::string, std::size_t>, std::uint32_t> baseOf_;  ///< by series and number of bytes
  std::vector<OwnBytes> bases_;
  std::vector<Packed> packed_;
  std::size_t bytes_ = 0;
};

}  // namespace volumen::dicom
