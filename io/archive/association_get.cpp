// Retrieval (PS3.4 C.4.2 and C.4.3, PS3.7 9.1.3 and 9.1.4).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>

#include <cstring>
#include <utility>

#include "io/archive/association_private.h"
#include "io/archive/receive_data_set.h"
#include "io/archive/received_files.h"
#include "io/dicom/instance_uids.h"
#include "io/worker/call.h"

namespace volumen {

namespace {

constexpr std::uint64_t mostBytesOfInstance = std::uint64_t(4) << 30;
constexpr int mostImagesAfterCancel = 1000;
constexpr int mostPending = 100000;  // answers, one after the other
// Some archives fetch from tapes before they send the first instance.
constexpr std::chrono::minutes mostSilenceOfMove{10};

// Returns what a status of C-GET or C-MOVE means (PS3.4 C.4.3.1.4), as the end of a sentence; empty if all
// was sent.
std::string retrievalRefusal(unsigned status) {
  switch (status) {
    case 0x0000:
      return "";
    case 0xb000:
      return "could not send all instances";
    case 0xa701:
    case 0xa702:
      return "has no resources to send them: try again";
    case 0xa801:
      return "does not know our AE title, or has no address for it";
    case 0xa900:
      return "does not understand the request (status A900)";
    case 0xfe00:
      return "was told to stop";
    default:
      return "ended the retrieval with status " + statusText(status);
  }
}

// One retrieval.
class Retrieval {
 public:
  // Without a sink no instances come over this association (C-MOVE).
  Retrieval(T_ASC_Association* association, Watch& watch, T_ASC_PresentationContextID context, DIC_US message,
            InstanceSink* sink)
      : association_(association), watch_(watch), context_(context), message_(message), sink_(sink) {}

  // Takes messages until the archive ends the retrieval. Sets `refusal` as retrievalRefusal() does.
  OFCondition take(std::string& refusal) {
    for (;;) {
      T_ASC_PresentationContextID context = 0;
      T_DIMSE_Message message{};
      watch_.allow(mostBytesOfCommand, std::chrono::hours(24));
      OFCondition done = receiveCommand(association_, context, message);
      if (done.bad()) return done;
      if (sink_ && message.CommandField == DIMSE_C_STORE_RQ) {
        done = store(context, message.msg.CStoreRQ);
      } else if (message.CommandField == (sink_ ? DIMSE_C_GET_RSP : DIMSE_C_MOVE_RSP)) {
        const bool isGet = sink_ != nullptr;
        const unsigned status = isGet ? message.msg.CGetRSP.DimseStatus : message.msg.CMoveRSP.DimseStatus;
        done = skipDataSet(association_,
                           isGet ? message.msg.CGetRSP.DataSetType : message.msg.CMoveRSP.DataSetType);
        if (done.good() && status != pending) {
          refusal = retrievalRefusal(status);
          return done;
        }
        if (++pending_ > mostPending) return endless();
      } else {
        return makeOFCondition(OFM_dcmnet, DIMSEC_UNEXPECTEDREQUEST, OF_error,
                               "sends another message than was asked for");
      }
      if (done.bad()) return done;
    }
  }

  // Why the sink takes no more.
  const Status& problem() const { return problem_; }

 private:
  static constexpr unsigned pending = 0xff00;

  static OFCondition endless() {
    return makeOFCondition(OFM_dcmnet, DIMSEC_UNEXPECTEDREQUEST, OF_error,
                           "sends without end what was not asked for");
  }

  OFCondition store(T_ASC_PresentationContextID context, const T_DIMSE_C_StoreRQ& request) {
    OFCondition done = EC_Normal;
    watch_.allow(mostBytesOfInstance, std::chrono::hours(24));
    isKept_ = false;
    const Result<std::string> path = problem_ ? sink_->begin() : problem_.error();
    if (path)
      done = receive(context, request, *path);
    else
      refuse(path.error()), done = skipDataSet(association_, request.DataSetType);
    if (done.bad()) return done;
    pending_ = 0;
    if (isCancelled_ && ++afterCancel_ > mostImagesAfterCancel) return endless();
    done = answerStorage(association_, context, request,
                         !problem_ ? outOfResources
                         : isKept_ ? 0
                                   : notUnderstood);
    if (done.good() && !problem_ && !std::exchange(isCancelled_, true))
      done = DIMSE_sendCancelRequest(association_, context_, message_);
    return done;
  }

  OFCondition receive(T_ASC_PresentationContextID context, const T_DIMSE_C_StoreRQ& request,
                      const std::string& path) {
    bool isWritten = false;
    const OFCondition done = receiveDataSet(association_, context, request, path, isWritten);
    if (done.bad() || !isWritten) sink_->drop();
    if (done.good() && !isWritten) refuse(cannotWriteInto(path));
    if (done.bad() || !isWritten) return done;
    // What the command says may be wrong; the data set counts.
    const auto uids = dicom::instanceUids(path);
    if (!uids) {
      sink_->drop();
      if (worker::isReasonOfMachine(uids.message()))
        refuse({"An image that came cannot be read: " + uids.message() + "."});
    } else if (const Status s = sink_->end(*uids); !s) {
      refuse(s.error());
    } else {
      isKept_ = sink_->has(uids->instance);
    }
    return done;
  }

  void refuse(const Error& error) {
    if (problem_) problem_ = error;
  }

  T_ASC_Association* association_;
  Watch& watch_;
  const T_ASC_PresentationContextID context_;
  const DIC_US message_;
  InstanceSink* const sink_;
  int pending_ = 0, afterCancel_ = 0;
  bool isKept_ = false, isCancelled_ = false;
  Status problem_;
};

}  // namespace

// Sends a request, and takes what the archive answers.
Result<std::string> Association::Private::retrieve(T_ASC_PresentationContextID context,
                                                   T_DIMSE_Message& message, DIC_US id, DcmDataset& keys,
                                                   InstanceSink* sink) {
  OFCondition done =
      DIMSE_sendMessageUsingMemoryData(association, context, &message, nullptr, &keys, nullptr, nullptr);
  std::string refusal;
  Retrieval retrieval(association, watch, context, id, sink);
  if (done.good()) done = retrieval.take(refusal);
  const Error failure = done.bad() ? this->failure(done) : Error();
  if (!retrieval.problem()) return retrieval.problem().error();
  if (done.bad()) return failure;
  return refusal.empty() ? refusal : says(refusal).message;
}

Result<std::string> Association::get(const std::string& model, DcmDataset& keys, InstanceSink& sink) {
  const T_ASC_PresentationContextID context = p_->contextOf(model);
  if (context == 0) return p_->says("offers no retrieval over one association (C-GET)");
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_GET_RQ;
  p_->fill(message.msg.CGetRQ, model);
  return p_->retrieve(context, message, message.msg.CGetRQ.MessageID, keys, &sink);
}

Result<std::string> Association::move(const std::string& model, DcmDataset& keys,
                                      const std::string& destination) {
  const T_ASC_PresentationContextID context = p_->contextOf(model);
  if (context == 0) return p_->says("offers no retrieval (C-MOVE)").message;
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_MOVE_RQ;
  T_DIMSE_C_MoveRQ& request = message.msg.CMoveRQ;
  p_->fill(request, model);
  std::strncpy(request.MoveDestination, destination.c_str(), sizeof request.MoveDestination - 1);
  p_->watch.silence = mostSilenceOfMove;
  return p_->retrieve(context, message, request.MessageID, keys, nullptr);
}

}  // namespace volumen
