#include "io/archive/association.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/cond.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmnet/dul.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "io/archive/association_private.h"
#include "io/archive/stored_syntaxes.h"
#include "io/archive/tls_layer.h"

namespace volumen {

namespace {

constexpr std::uint64_t mostBytesOfAssociation = 1 << 20;
constexpr int connectSeconds = 5, associationSeconds = 10, silenceSeconds = 30;
constexpr std::size_t mostContexts = 128;  // odd numbers up to 255 (PS3.8 9.3.2.2)

// The innermost cause of a failure. DCMTK writes each cause in a line of its own: "0006:031d TEXT".
struct Cause {
  unsigned code;
  std::string text;  // without a full stop
};

Cause causeOf(const OFCondition& why) {
  Cause cause{why.code(), why.text()};
  const auto isEnd = [](char c) { return c == '.' || c == '\n' || c == ' '; };
  while (!cause.text.empty() && isEnd(cause.text.back())) cause.text.pop_back();
  cause.text = cause.text.substr(cause.text.rfind('\n') + 1);
  unsigned module = 0, code = 0;
  int length = 0;
  if (std::sscanf(cause.text.c_str(), "%4x:%4x %n", &module, &code, &length) == 2 && length == 10) {
    cause.code = code;
    cause.text.erase(0, 10);
  }
  cause.text = cause.text.substr(0, cause.text.find(" occurred in routine"));
  const std::size_t colon = cause.text.rfind(": ");
  if (colon != std::string::npos && !cause.text.starts_with("DIMSE"))
    cause.text = cause.text.substr(colon + 2);
  return cause;
}

std::string inSeconds(std::chrono::seconds time) { return std::to_string(time.count()) + " s"; }

// Return why a connection failed, as the end of a sentence.
std::string tlsFailure(const Archive& archive, const std::string& reason) {
  if (reason.find("certificate verify failed") != std::string::npos)
    return "has a certificate that " + archive.tls->ca + " does not vouch for.";
  return "does not agree on TLS: " + reason + ". It may not use TLS on this port.";
}

std::string hangUp(const Archive& archive) {
  if (archive.tls && archive.tls->certificate.empty())
    return "ends the connection at once: it may want a certificate of ours, or not know our AE title " +
           archive.callingAe + ".";
  return std::string("ends the connection at once: it may ") + (archive.tls ? "" : "expect TLS, or ") +
         "not know our AE title " + archive.callingAe + ".";
}

// Returns why an association was rejected (PS3.8 9.3.4), as the end of a sentence.
std::string whyRejected(const T_ASC_RejectParameters& rejected, const Archive& archive) {
  switch (rejected.reason) {
    case ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED:
      return "does not go by the AE title " + archive.calledAe + ": correct \"calledAe\"";
    case ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED:
      return "does not know our AE title " + archive.callingAe +
             ": enter it there, with the address of this machine, or correct \"callingAe\"";
    case ASC_REASON_SP_PRES_TEMPORARYCONGESTION:
    case ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED:
      return "is busy: try again";
    default:
      return "rejects the association without a usual reason: it may not know our AE title " +
             archive.callingAe;
  }
}

}  // namespace

std::string statusText(unsigned status) {
  char text[8];
  std::snprintf(text, sizeof text, "%04X", status & 0xffff);
  return text;
}

WantedService plainService(const std::string& sopClass) {
  return {sopClass, {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax}};
}

Association::Private::Private(Archive to, const CancelToken& cancel) : archive(std::move(to)) {
  watch.cancel = cancel;
  watch.silence = std::chrono::seconds(associationSeconds);
  if (archive.tls) watch.pin = archive.tls->pin;
}

Association::Private::~Private() {
  if (association) {
    // The peer is told, but not waited for.
    watch.cancel = CancelToken();
    watch.silence = std::chrono::seconds(2);
    watch.allow(1 << 20, watch.silence);
    if (broken || ASC_releaseAssociation(association).bad()) ASC_abortAssociation(association);
    ASC_destroyAssociation(&association);
  }
  ASC_dropNetwork(&network);
}

Status Association::Private::prepare() {
  if (archive.tls) {
    auto layer = tlsLayer(*archive.tls, NET_REQUESTOR);
    if (!layer) return layer.error();
    tls = std::move(*layer);
  }
  transport = std::make_unique<WatchedTransport>(tls ? *tls : plain, watch);
  dcmConnectionTimeout.set(connectSeconds);
  if (ASC_initializeNetwork(NET_REQUESTOR, 0, associationSeconds, &network).bad() ||
      ASC_setTransportLayer(network, transport.get(), 0).bad())
    return Error{"The network cannot be used."};
  return {};
}

Error Association::Private::says(const std::string& predicate) const {
  return {"The archive \"" + archive.name + "\" " + predicate + "."};
}

Error Association::Private::failure(const OFCondition& why, T_ASC_Parameters* parameters) {
  broken = true;
  const std::string name =
      "The archive \"" + archive.name + "\" (" + archive.host + ":" + std::to_string(archive.port) + ") ";
  const Cause cause = causeOf(why);
  if (watch.cancel.cancelled()) return {"cancelled"};
  if (!watch.otherCertificate.empty())
    return {name + "has another certificate than the pinned one: its SHA-256 is " + watch.otherCertificate +
            "."};
  if (watch.sentTooMuch) return {name + "sent an answer that is too large."};
  if (watch.wasSilent || cause.code == DULC_READTIMEOUT)
    return {name + "does not answer within " + inSeconds(watch.silence) + "."};
  if (why.module() == OFM_dcmtls) return {name + tlsFailure(archive, cause.text)};
  switch (cause.code) {
    case DULC_UNKNOWNHOST:
      return {name + "cannot be found: no address is known for this host."};
    case DULC_TCPINITERROR:
      if (cause.text.ends_with("(Timeout)"))
        return {name + "does not answer within " + inSeconds(std::chrono::seconds(connectSeconds)) +
                ": are address and port right, and does a firewall let them pass?"};
      return {name + "cannot be reached: " + cause.text + "."};
    case DULC_ASSOCIATIONREJECTED: {
      T_ASC_RejectParameters rejected{};
      if (parameters) ASC_getRejectParameters(parameters, &rejected);
      return {name + whyRejected(rejected, archive) + "."};
    }
    case DULC_PEERABORTEDASSOCIATION:
    case DULC_PEERREQUESTEDRELEASE:
    case DULC_NETWORKCLOSED:
    case DULC_TCPIOERROR:
      return {name + (associated ? "ended the connection." : hangUp(archive))};
    case DULC_ILLEGALPDU:
    case DULC_ILLEGALPDULENGTH:
    case DULC_UNRECOGNIZEDPDUTYPE:
      if (!associated)
        return {name + "does not answer in DICOM: is this the port of another service, or does it use TLS?"};
      break;
    case DIMSEC_UNEXPECTEDREQUEST:  // that of Retrieval
      return {name + cause.text + "."};
    default:
      if (!associated) return {name + "fails: " + cause.text + "."};
  }
  return {name + "does not keep to DICOM (" + cause.text + ")."};
}

T_ASC_PresentationContextID Association::Private::contextOf(const std::string& sopClass) const {
  return ASC_findAcceptedPresentationContextID(association, sopClass.c_str());
}

T_ASC_PresentationContextID Association::Private::contextOf(const std::string& sopClass,
                                                            const std::string& syntax) const {
  const auto found = contexts.find({sopClass, syntax});
  return found == contexts.end() ? T_ASC_PresentationContextID(0) : found->second;
}

// DCMTK neither sends nor takes commands in contexts of transfer syntaxes that it does not know, although
// commands have one of their own (PS3.7 6.3.1).
void Association::Private::noteContexts() {
  LST_HEAD* list = association->params->DULparams.requestedPresentationContext;
  if (!list) return;
  auto* one = static_cast<DUL_PRESENTATIONCONTEXT*>(LST_Head(&list));
  LST_Position(&list, one);
  for (; one; one = static_cast<DUL_PRESENTATIONCONTEXT*>(LST_Next(&list))) {
    if (one->result != DUL_PRESENTATION_ACCEPT) continue;
    const std::string syntax = one->acceptedTransferSyntax;
    contexts.try_emplace({one->abstractSyntax, syntax}, one->presentationContextID);
    if (std::ranges::find(storedSyntaxes, syntax) == storedSyntaxes.end())
      std::strcpy(one->acceptedTransferSyntax, UID_LittleEndianExplicitTransferSyntax);
  }
}

Association::Association(std::unique_ptr<Private> p) : p_(std::move(p)) {}
Association::Association(Association&&) noexcept = default;
Association::~Association() = default;

Result<Association> Association::open(const Archive& archive, const std::vector<WantedService>& services,
                                      const CancelToken& cancel) {
  auto p = std::make_unique<Private>(archive, cancel);
  if (Status s = p->prepare(); !s) return s.error();
  T_ASC_Parameters* parameters = nullptr;
  // Fewer PDUs than by DCMTK's default of 16 KiB. PduReader leaves one value in each, however many come.
  ASC_createAssociationParameters(&parameters, ASC_MAXIMUMPDUSIZE);
  ASC_setAPTitles(parameters, archive.callingAe.c_str(), archive.calledAe.c_str(), nullptr);
  ASC_setTransportLayerType(parameters, archive.tls.has_value());
  ASC_setPresentationAddresses(parameters, "localhost",
                               (archive.host + ":" + std::to_string(archive.port)).c_str());
  for (std::size_t n = 0; n < std::min(services.size(), mostContexts); ++n) {
    std::vector<const char*> syntaxes;
    for (const std::string& syntax : services[n].syntaxes) syntaxes.push_back(syntax.c_str());
    ASC_addPresentationContext(parameters, T_ASC_PresentationContextID(2 * n + 1),
                               services[n].sopClass.c_str(), syntaxes.data(), int(syntaxes.size()),
                               services[n].isReceived ? ASC_SC_ROLE_SCP : ASC_SC_ROLE_DEFAULT);
  }
  p->watch.allow(mostBytesOfAssociation, std::chrono::seconds(associationSeconds + connectSeconds));
  const OFCondition done = ASC_requestAssociation(p->network, parameters, &p->association);
  if (done.bad()) {
    const Error error = p->failure(done, parameters);
    if (!p->association) ASC_destroyAssociationParameters(&parameters);
    return error;
  }
  p->associated = true;
  p->noteContexts();
  p->watch.allow(mostBytesOfCommand, std::chrono::hours(24));
  p->watch.silence = std::chrono::seconds(silenceSeconds);
  return Association(std::move(p));
}

bool Association::offers(const std::string& sopClass) const { return p_->contextOf(sopClass) != 0; }

Status Association::echo() {
  if (!offers(UID_VerificationSOPClass)) return p_->says("offers no verification (C-ECHO)");
  DIC_US status = 0;
  p_->watch.allow(mostBytesOfCommand, p_->watch.silence);
  DcmDataset* detail = nullptr;
  const OFCondition done =
      DIMSE_echoUser(p_->association, p_->association->nextMsgID++, DIMSE_BLOCKING, 0, &status, &detail);
  delete detail;
  if (done.bad()) return p_->failure(done);
  if (status != 0) return p_->says("answers the test with status " + statusText(status));
  return {};
}

namespace {

constexpr std::chrono::minutes mostTimeOfAnswer{2};
constexpr int mostAfterCancel = 10000;

struct Answers {
  T_ASC_Association* association;
  Watch& watch;
  T_ASC_PresentationContextID context;
  const std::function<bool(DcmDataset&)>& onAnswer;
  bool stopped = false;
  int dropped = 0;
};

void onFound(void* data, T_DIMSE_C_FindRQ* request, int, T_DIMSE_C_FindRSP*, DcmDataset* answer) {
  Answers& answers = *static_cast<Answers*>(data);
  answers.watch.allow(mostBytesOfCommand, mostTimeOfAnswer);
  if (answers.stopped) {
    // Answers on the way are dropped, unless they never end.
    if (++answers.dropped > mostAfterCancel) answers.watch.sentTooMuch = true, answers.watch.bytesLeft = 0;
    return;
  }
  if (!answer || answers.onAnswer(*answer)) return;
  answers.stopped = true;
  DIMSE_sendCancelRequest(answers.association, answers.context, request->MessageID);
}

// Returns what a status of C-FIND means (PS3.4 C.4.1.1.4), as the end of a sentence.
std::string searchRefusal(unsigned status) {
  if (status == STATUS_FIND_Refused_OutOfResources)
    return "refuses the search as too large: add a word or a date";
  if (status == STATUS_FIND_Error_DataSetDoesNotMatchSOPClass)
    return "does not understand the search (status A900)";
  return "ended the search with status " + statusText(status);
}

}  // namespace

Result<std::string> Association::find(const std::string& model, DcmDataset& keys,
                                      const std::function<bool(DcmDataset&)>& onAnswer) {
  const T_ASC_PresentationContextID context = p_->contextOf(model);
  if (context == 0) return p_->says("offers no search (C-FIND)");
  T_DIMSE_C_FindRQ request{};
  p_->fill(request, model);
  Answers answers{p_->association, p_->watch, context, onAnswer};
  p_->watch.allow(mostBytesOfCommand, mostTimeOfAnswer);
  T_DIMSE_C_FindRSP response{};
  DcmDataset* detail = nullptr;
  int count = 0;
  const OFCondition done = DIMSE_findUser(p_->association, context, &request, &keys, count, onFound, &answers,
                                          DIMSE_BLOCKING, 0, &response, &detail);
  delete detail;
  if (done.bad()) {
    const Error failure = p_->failure(done);
    if (answers.stopped && p_->watch.sentTooMuch) return std::string();
    return failure;
  }
  const unsigned status = response.DimseStatus;
  const bool isEnd = status == STATUS_FIND_Success || (answers.stopped && status == STATUS_FIND_Cancel);
  return isEnd ? std::string() : p_->says(searchRefusal(status)).message;
}

}  // namespace volumen
