#include "io/archive/receive_data_set.h"

#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcostrma.h>
#include <dcmtk/dcmdata/dcostrmf.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace volumen {

namespace {

// Passes bytes on to a file and takes those, too, that cannot be written. If a write fails, DCMTK skips the
// rest of the data set; after its last bytes it would wait for more that never come.
class TakesAll : public DcmConsumer {
 public:
  explicit TakesAll(DcmOutputStream& file) : file_(file) {}
  bool isLost() const { return isLost_; }

  OFBool good() const override { return OFTrue; }
  OFCondition status() const override { return EC_Normal; }
  OFBool isFlushed() const override { return OFTrue; }
  offile_off_t avail() const override { return file_.avail(); }
  offile_off_t write(const void* bytes, offile_off_t count) override {
    isLost_ = isLost_ || file_.write(bytes, count) != count;
    return count;
  }
  void flush() override {}

 private:
  DcmOutputStream& file_;
  bool isLost_ = false;
};

class TakingStream : public DcmOutputStream {
 public:
  explicit TakingStream(DcmConsumer& consumer) : DcmOutputStream(&consumer) {}
};

}  // namespace

OFCondition receiveCommand(T_ASC_Association* association, T_ASC_PresentationContextID& context,
                           T_DIMSE_Message& message) {
  DcmDataset* detail = nullptr;
  const OFCondition done = DIMSE_receiveCommand(association, DIMSE_BLOCKING, 0, &context, &message, &detail);
  delete detail;
  // DCMTK expects its callers to free this list. We never answer N-GET, so it is freed here.
  if (done.good() && message.CommandField == DIMSE_N_GET_RQ) {
    std::free(message.msg.NGetRQ.AttributeIdentifierList);
    message.msg.NGetRQ.AttributeIdentifierList = nullptr;
  }
  return done;
}

OFCondition receiveDataSet(T_ASC_Association* association, T_ASC_PresentationContextID context,
                           const T_DIMSE_C_StoreRQ& request, const std::string& path, bool& isWritten) {
  isWritten = false;
  DcmOutputFileStream* made = nullptr;
  if (DIMSE_createFilestream(OFFilename(path.c_str()), &request, association, context, 1, &made).bad())
    return skipDataSet(association, request.DataSetType);
  std::unique_ptr<DcmOutputFileStream> file(made);
  TakesAll consumer(*file);
  TakingStream stream(consumer);
  T_ASC_PresentationContextID dataContext = 0;
  const OFCondition done =
      DIMSE_receiveDataSetInFile(association, DIMSE_BLOCKING, 0, &dataContext, &stream, nullptr, nullptr);
  if (done.bad()) return done;
  if (dataContext != context)
    return makeOFCondition(OFM_dcmnet, DIMSEC_INVALIDPRESENTATIONCONTEXTID, OF_error,
                           "the data set comes in another presentation context than its command");
  // DCMTK does not tell whether the last bytes could be written when it closes the file.
  const offile_off_t expected = file->tell();
  file.reset();
  std::error_code error;
  isWritten = !consumer.isLost() && std::filesystem::file_size(path, error) == std::uintmax_t(expected);
  return done;
}

OFCondition answerStorage(T_ASC_Association* association, T_ASC_PresentationContextID context,
                          const T_DIMSE_C_StoreRQ& request, unsigned status) {
  T_DIMSE_C_StoreRSP response{};  // DCMTK adds what the request says
  response.DimseStatus = DIC_US(status);
  response.DataSetType = DIMSE_DATASET_NULL;
  return DIMSE_sendStoreResponse(association, context, &request, &response, nullptr);
}

OFCondition skipDataSet(T_ASC_Association* association, T_DIMSE_DataSetType type) {
  if (type == DIMSE_DATASET_NULL) return EC_Normal;
  DIC_UL bytes = 0, parts = 0;
  return DIMSE_ignoreDataSet(association, DIMSE_BLOCKING, 0, &bytes, &parts);
}

}  // namespace volumen
