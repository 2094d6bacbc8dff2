// The acceptor's side of an association (PS3.8 7.1), and of C-STORE and C-ECHO over it (PS3.7 9.1.1, 9.1.5).
#include "io/archive/incoming_association.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/cond.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmnet/dul.h>
#include <dcmtk/dcmtls/tlslayer.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string_view>

#include "io/archive/association_private.h"
#include "io/archive/offered_contexts.h"
#include "io/archive/receive_data_set.h"
#include "io/archive/watched_transport.h"

namespace volumen {

namespace {

constexpr unsigned noSuchClass = 0x0122;  // status (PS3.7 C.5.6)
constexpr long mostBytesOfPdu = 65536;    // longer ones would not be quicker
constexpr int requestSeconds = 3, idleSeconds = 30;
constexpr std::chrono::seconds mostTimeOfRequest{10}, mostTimeOfFarewell{2};
constexpr std::chrono::hours mostTimeOfInstance{1};

// DCMTK takes a socket that was accepted elsewhere from a variable of the process. This transport lets the
// next thread set it as soon as the connection of this one is made, before anything is read from the peer.
class HandedOver : public WatchedTransport {
 public:
  HandedOver(DcmTransportLayer& inner, Watch& watch) : WatchedTransport(inner, watch), one_(turn()) {}

  /// Gives DCMTK the socket, which the connection closes. Waits for other threads that do so.
  void offer(int socket) {
    one_.lock();
    dcmExternalSocketHandle.set(socket);
  }
  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override {
    DcmTransportConnection* connection = WatchedTransport::createConnection(socket, secure);
    finish();
    return connection;
  }
  /// Returns whether DCMTK left the socket.
  bool finish() {
    if (!one_) return false;
    dcmExternalSocketHandle.set(-1);
    one_.unlock();
    return true;
  }

 private:
  static std::unique_lock<std::mutex> turn() {
    static std::mutex mutex;
    return {mutex, std::defer_lock};
  }
  std::unique_lock<std::mutex> one_;
};

// Why an association is not accepted.
struct Rejection {
  T_ASC_RejectParameters answer;
  std::string problem;
};

// AE titles are padded with spaces, by some peers in front (PS3.5 6.2).
std::string withoutPadding(const std::string& title) {
  const std::size_t first = title.find_first_not_of(' '), last = title.find_last_not_of(' ');
  return first == std::string::npos ? "" : title.substr(first, last - first + 1);
}

class Incoming {
 public:
  Incoming(Reception& reception, const std::string& address) : reception_(reception) {
    report_.address = address;
    watch_.cancel = reception.cancel;
  }
  ~Incoming() {
    if (isCounted_) --reception_.associations;
    ASC_destroyAssociation(&association_);
    ASC_dropNetwork(&network_);
  }

  std::optional<ReceivedAssociation> serve(int socket) {
    if (!receiveRequest(socket))
      return report_.problem.empty() ? std::nullopt : std::optional<ReceivedAssociation>(report_);
    if (const std::optional<Rejection> rejection = whyRejected()) {
      report_.problem = rejection->problem;
      ASC_rejectAssociation(association_, &rejection->answer);
      leave();
      return report_;
    }
    acceptContexts(*association_->params);
    OFCondition done = ASC_acknowledgeAssociation(association_);
    watch_.silence = std::chrono::seconds(idleSeconds);
    while (done.good()) done = answerNext();
    end(done);
    return report_;
  }

 private:
  bool receiveRequest(int socket) {
    watch_.silence = std::chrono::seconds(requestSeconds);
    watch_.allow(mostBytesOfCommand, mostTimeOfRequest);
    transport_.offer(socket);
    OFCondition done = ASC_initializeNetwork(NET_ACCEPTOR, 0, requestSeconds, &network_);
    if (done.good()) done = ASC_setTransportLayer(network_, &transport_, 0);
    if (done.good())
      done = ASC_receiveAssociation(network_, &association_, mostBytesOfPdu, nullptr, nullptr,
                                    reception_.tls != nullptr, DUL_BLOCK);
    if (transport_.finish()) ::close(socket);
    if (done.module() == OFM_dcmtls) return failTls();
    // DCMTK takes it for no error if the peer closes the connection first. Only a request has contexts.
    if (done.bad() || !association_->params->DULparams.requestedPresentationContext) return false;
    report_.callingAe = withoutPadding(association_->params->DULparams.callingAPTitle);
    return true;
  }

  bool failTls() {
    const std::string& ca = reception_.listening.tls->ca;
    report_.callingAe = "A peer";
    report_.problem = "was cut off: it does not agree on TLS" +
                      (ca.empty() ? "" : ", or has no certificate that " + ca + " vouches for");
    return false;
  }

  std::optional<Rejection> whyRejected() {
    const Listening& listening = reception_.listening;
    const std::string called = withoutPadding(association_->params->DULparams.calledAPTitle);
    if (called != withoutPadding(listening.ae))
      return Rejection{
          {ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER, ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED},
          "was rejected: it calls \"" + called + "\", not \"" + listening.ae + "\""};
    if (withoutPadding(association_->params->DULparams.applicationContextName) !=
        UID_StandardApplicationContext)
      return Rejection{
          {ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER, ASC_REASON_SU_APPCONTEXTNAMENOTSUPPORTED},
          "was rejected: its application context is not DICOM's"};
    const auto isPeer = [&](const std::string& peer) { return withoutPadding(peer) == report_.callingAe; };
    if (!listening.peers.empty() && std::ranges::none_of(listening.peers, isPeer))
      return Rejection{
          {ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER, ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED},
          "was rejected: it is none of the \"peers\""};
    // Those who may not send take no place.
    isCounted_ = true;
    if (++reception_.associations > listening.mostAssociations)
      return Rejection{{ASC_RESULT_REJECTEDTRANSIENT, ASC_SOURCE_SERVICEPROVIDER_PRESENTATION_RELATED,
                        ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED},
                       "was rejected: " + std::to_string(listening.mostAssociations) +
                           " associations are open already (\"mostAssociations\")"};
    return {};
  }

  // Receives a command and answers it.
  OFCondition answerNext() {
    T_ASC_PresentationContextID context = 0;
    T_DIMSE_Message message{};
    watch_.allow(mostBytesOfCommand, watch_.silence);
    const OFCondition done = receiveCommand(association_, context, message);
    if (done.bad()) return done;
    if (message.CommandField == DIMSE_C_STORE_RQ) return store(context, message.msg.CStoreRQ);
    if (message.CommandField == DIMSE_C_CANCEL_RQ) return done;  // too late: each request is answered at once
    if (message.CommandField != DIMSE_C_ECHO_RQ)
      return makeOFCondition(OFM_dcmnet, DIMSEC_UNEXPECTEDREQUEST, OF_error,
                             "asks for a service that volumen does not offer");
    report_.isVerified = true;
    return DIMSE_sendEchoResponse(association_, context, &message.msg.CEchoRQ, STATUS_Success, nullptr);
  }

  OFCondition store(T_ASC_PresentationContextID context, const T_DIMSE_C_StoreRQ& request) {
    watch_.allow(std::uint64_t(reception_.listening.mostMegabytes) * 1'000'000, mostTimeOfInstance);
    isInInstance_ = true;
    Filed filed;
    OFCondition done = file(context, request, filed);
    if (done.bad()) return done;
    isInInstance_ = false;
    done = answerStorage(association_, context, request, filed.status);
    note(filed);
    return done;
  }

  OFCondition file(T_ASC_PresentationContextID context, const T_DIMSE_C_StoreRQ& request, Filed& filed) {
    Result<OutputFile> instance = reception_.files.begin();
    if (!instance || request.DataSetType == DIMSE_DATASET_NULL) {
      filed.status = instance ? notUnderstood : outOfResources;
      filed.problem = instance ? "a request has no image" : instance.message();
      return skipDataSet(association_, request.DataSetType);
    }
    if (isVerification(context)) {
      filed.status = noSuchClass;
      filed.problem = "an image comes where only verification was agreed on";
      return skipDataSet(association_, request.DataSetType);
    }
    bool isWritten = false;
    const OFCondition done = receiveDataSet(association_, context, request, instance->asidePath(), isWritten);
    if (done.bad()) return done;
    if (isWritten) {
      filed = reception_.files.file(*instance);
    } else {
      filed.status = outOfResources;
      filed.problem = "an image cannot be written: the disk may be full";
    }
    return done;
  }

  bool isVerification(T_ASC_PresentationContextID context) const {
    T_ASC_PresentationContext found;
    return ASC_findAcceptedPresentationContext(association_->params, context, &found).good() &&
           std::string_view(found.abstractSyntax) == UID_VerificationSOPClass;
  }

  void note(const Filed& filed) {
    if (filed.status != 0) {
      ++report_.refused;
      if (report_.problem.empty()) report_.problem = filed.problem;
      return;
    }
    ++(filed.alreadyHere ? report_.alreadyHere : report_.stored);
    const std::filesystem::path path = filed.path;
    if (reception_.onStored)
      reception_.onStored({filed.path, path.parent_path().parent_path().string(), filed.uids.study,
                           filed.uids.series, filed.uids.instance, report_.callingAe, filed.bytes,
                           filed.alreadyHere});
  }

  // Ends the association after the last answer, and keeps why.
  void end(const OFCondition& why) {
    if (why == DUL_PEERREQUESTEDRELEASE) {
      ASC_acknowledgeRelease(association_);
      return leave();
    }
    if (const std::string problem = failure(why); report_.problem.empty()) report_.problem = problem;
    if (why == DUL_PEERABORTEDASSOCIATION) return;
    forFarewell();
    ASC_abortAssociation(association_);
  }

  std::string failure(const OFCondition& why) const {
    const std::string where = isInInstance_ ? " within an image" : "";
    // Not `cancel`: it may be set after the peer has broken off.
    if (watch_.wasCancelled) return "was cut off" + where + ", as volumen ends";
    if (watch_.sentTooMuch && isInInstance_)
      return "was cut off: its image has more than " + std::to_string(reception_.listening.mostMegabytes) +
             " megabytes (\"mostMegabytes\")";
    if (watch_.wasSilent)
      return "was cut off" + where + ": it was silent for " + std::to_string(idleSeconds) + " s";
    if (why.code() == DIMSEC_UNEXPECTEDREQUEST) return why.text();
    return "broke off" + where;
  }

  // Waits a little for the peer to close the connection: it might not read the last answer else.
  void leave() {
    forFarewell();
    ASC_dropSCPAssociation(association_, int(mostTimeOfFarewell.count()));
  }
  void forFarewell() {
    watch_.cancel = CancelToken();
    watch_.silence = mostTimeOfFarewell;
    watch_.allow(mostBytesOfCommand, mostTimeOfFarewell);
  }

  Reception& reception_;
  ReceivedAssociation report_;
  Watch watch_;
  DcmTransportLayer plain_;
  HandedOver transport_{reception_.tls ? *reception_.tls : plain_, watch_};
  T_ASC_Network* network_ = nullptr;
  T_ASC_Association* association_ = nullptr;
  bool isCounted_ = false, isInInstance_ = false;
};

}  // namespace

std::optional<ReceivedAssociation> serveConnection(Reception& reception, int socket,
                                                   const std::string& address) {
  return Incoming(reception, address).serve(socket);
}

}  // namespace volumen
