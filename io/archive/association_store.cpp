// Sending over one association (PS3.4 B, PS3.7 9.1.1).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcostrma.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "io/archive/association_private.h"
#include "io/dicom/stored_data_set.h"
#include "io/dicom/transfer_syntax.h"
#include "io/regular_file.h"

namespace volumen {

namespace {

// Returns what a status of C-STORE means (PS3.4 B.2.3, PS3.7 C), as the end of a sentence; empty if it is
// stored, with a warning or without.
std::string storageRefusal(unsigned status) {
  constexpr unsigned duplicate = 0x0111;
  if (status == 0 || (status >= 0xb000 && status <= 0xbfff)) return "";
  if (status == duplicate) return "has an image of this UID already, which may differ (status 0111)";
  if ((status & 0xff00) == 0xa700)
    return "says that it is out of resources (status " + statusText(status) + ")";
  if ((status & 0xff00) == 0xa900)
    return "finds that it contradicts its class (status " + statusText(status) + ")";
  if ((status & 0xf000) == 0xc000) return "does not understand it (status " + statusText(status) + ")";
  return "refuses it with status " + statusText(status);
}

// Returns the name of a UID, or the UID.
std::string nameOf(const std::string& uid) {
  const char* const name = dcmFindNameOfUID(uid.c_str());
  if (name) return name;
  const dicom::TransferSyntax syntax = dicom::transferSyntax(uid);
  return *syntax.name ? syntax.name : uid;
}

// Returns bytes from `at` on and their number, 0 if they cannot be had.
using ReadBytes = std::function<std::size_t(std::uint64_t at, void* to, std::size_t count)>;

// A data set that is sent byte by byte: what DCMTK has not parsed, it cannot change, nor be attacked by.
class SentBytes : public DcmDataset {
 public:
  SentBytes(std::uint64_t size, ReadBytes read) : size_(size), read_(std::move(read)) {}

  OFBool isEmpty(OFBool) override { return size_ == 0; }
  OFBool canWriteXfer(E_TransferSyntax, E_TransferSyntax) override { return OFTrue; }
  using DcmDataset::write;
  OFCondition write(DcmOutputStream& out, E_TransferSyntax, E_EncodingType, DcmWriteCache*, E_GrpLenEncoding,
                    E_PaddingEncoding, Uint32, Uint32, Uint32) override {
    char some[1 << 14];
    while (at_ < size_ && out.avail() > 0) {
      const std::uint64_t room = std::min<std::uint64_t>(sizeof some, std::uint64_t(out.avail()));
      const std::size_t count = read_(at_, some, std::size_t(std::min(room, size_ - at_)));
      if (count == 0) return EC_InvalidStream;
      out.write(some, offile_off_t(count));
      at_ += count;
    }
    return at_ == size_ ? EC_Normal : EC_StreamNotifyClient;
  }

 private:
  const std::uint64_t size_;
  const ReadBytes read_;
  std::uint64_t at_ = 0;
};

std::uint64_t sizeOf(const dicom::StoredDataSet& stored) { return stored.end - stored.begin; }

// Messages have an even length. DCMTK pads others, which only deflated data allow (PS3.5 A.5).
bool canBeSent(const dicom::StoredDataSet& stored) {
  return sizeOf(stored) % 2 == 0 || stored.syntax == UID_DeflatedExplicitVRLittleEndianTransferSyntax;
}

}  // namespace

Result<std::string> Association::store(const dicom::InstanceUids& uids, const std::string& path) {
  const CancelToken& cancel = p_->watch.cancel;
  const auto stored = dicom::storedDataSet(path, cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  if (!stored) return "it cannot be read: " + stored.message();
  std::string problem;
  for (const std::string& syntax : {stored->syntax, std::string(UID_LittleEndianExplicitTransferSyntax),
                                    std::string(UID_LittleEndianImplicitTransferSyntax),
                                    std::string(UID_BigEndianExplicitTransferSyntax)}) {
    const T_ASC_PresentationContextID context = p_->contextOf(uids.sopClass, syntax);
    if (context == 0) continue;
    if (syntax == stored->syntax && canBeSent(*stored)) {
      const Result<RegularFile> file = RegularFile::open(path);
      if (!file) return "it cannot be read: " + file.message();
      SentBytes bytes(sizeOf(*stored), [&](std::uint64_t at, void* to, std::size_t count) {
        const auto some = file->readAt(stored->begin + at, to, count);
        return some ? *some : 0;
      });
      return p_->store(uids, context, bytes);
    }
    const auto converted = dicom::inSyntax(path, *stored, syntax, cancel);
    if (cancel.cancelled()) return Error{"cancelled"};
    if (!converted) {
      problem = ", and " + converted.message();
      continue;
    }
    SentBytes bytes(converted->size(), [&](std::uint64_t at, void* to, std::size_t count) {
      std::memcpy(to, converted->data() + at, count);
      return count;
    });
    return p_->store(uids, context, bytes);
  }
  return p_->says("takes no " + nameOf(stored->syntax) + " of class " + nameOf(uids.sopClass) + problem)
      .message;
}

Result<std::string> Association::Private::store(const dicom::InstanceUids& uids,
                                                T_ASC_PresentationContextID context, DcmDataset& data) {
  T_DIMSE_C_StoreRQ request{};
  fill(request, uids.sopClass);
  std::strncpy(request.AffectedSOPInstanceUID, uids.instance.c_str(),
               sizeof request.AffectedSOPInstanceUID - 1);
  watch.allow(mostBytesOfCommand, std::chrono::hours(24));
  T_DIMSE_C_StoreRSP response{};
  DcmDataset* detail = nullptr;
  const OFCondition done = DIMSE_storeUser(association, context, &request, nullptr, &data, nullptr, nullptr,
                                           DIMSE_BLOCKING, 0, &response, &detail);
  delete detail;
  if (done.bad()) return failure(done);
  const std::string answered =
      response.opts & O_STORE_AFFECTEDSOPINSTANCEUID ? response.AffectedSOPInstanceUID : "";
  if (!answered.empty() && answered != uids.instance) return says("answers for another image").message;
  const std::string refusal = storageRefusal(response.DimseStatus);
  return refusal.empty() ? refusal : says(refusal).message;
}

}  // namespace volumen
