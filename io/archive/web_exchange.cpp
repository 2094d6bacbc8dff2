#include "io/archive/web_exchange.h"

#include <QEventLoop>
#include <QFile>
#include <QHttpMultiPart>
#include <QNetworkAccessManager>
#include <QNetworkReply>
#include <QSslCertificate>
#include <QSslConfiguration>
#include <QSslKey>
#include <QThread>
#include <QTimer>
#include <new>

#include "io/archive/secret_command.h"
#include "io/qt_application.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds, std::chrono::seconds;

// Archives may work for minutes on what they were sent.
constexpr seconds connectTime{5}, silenceTime{30}, silenceAfterUpload{300}, mostTimeOfPause{30};
constexpr milliseconds lookEvery{20};
constexpr int mostTries = 4, mostRedirects = 5;
constexpr qint64 bytesAtOnce = 1 << 20;

bool isRedirect(int status) {
  return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}
bool isBusy(int status) { return status == 429 || status == 500 || status == 502 || status == 503; }
bool hasBody(int status) { return (status >= 200 && status < 300) || status == 409; }

bool isSameHost(const QUrl& a, const QUrl& b) {
  return a.scheme() == b.scheme() && a.host() == b.host() &&
         a.port(a.scheme() == u"https" ? 443 : 80) == b.port(b.scheme() == u"https" ? 443 : 80);
}

std::string placeOf(const QUrl& url) {
  return url.toString(QUrl::RemovePath | QUrl::RemoveQuery | QUrl::RemoveFragment | QUrl::RemoveUserInfo)
      .toStdString();
}

std::string sha256Of(const QSslCertificate& certificate) {
  return certificate.digest(QCryptographicHash::Sha256).toHex().toStdString();
}

// What one request came to.
struct Outcome {
  WebAnswer answer;
  QUrl redirect;
  seconds pause{0};  // that a busy archive asks for
  Status problem;    // why there is no answer
};

// One request, whose reply it owns.
class Request {
 public:
  Request(const Archive& archive, const CancelToken& cancel, const WebExchange::OnBody& onBody)
      : archive_(archive), cancel_(cancel), onBody_(onBody) {}

  Outcome run(QNetworkReply* reply) {
    reply_.reset(reply);
    reply->setReadBufferSize(bytesAtOnce);
    QEventLoop loop;
    QTimer timer;
    QObject::connect(reply, &QNetworkReply::requestSent, &loop,
                     [this] { hasConnection_ = true, progress(); });
    QObject::connect(reply, &QNetworkReply::metaDataChanged, &loop, [this] { progress(); });
    QObject::connect(reply, &QNetworkReply::uploadProgress, &loop, [this] { progress(); });
    QObject::connect(reply, &QNetworkReply::readyRead, &loop, [this] { take(); });
    QObject::connect(reply, &QNetworkReply::sslErrors, &loop,
                     [this](const QList<QSslError>& errors) { judge(errors); });
    QObject::connect(reply, &QNetworkReply::encrypted, &loop, [this] { judge({}); });
    QObject::connect(reply, &QNetworkReply::finished, &loop, &QEventLoop::quit);
    QObject::connect(&timer, &QTimer::timeout, &loop, [this] { watch(); });
    timer.start(lookEvery);
    progress();
    if (!reply->isFinished()) loop.exec();
    take();
    return outcome();
  }

 private:
  struct Deleter {
    void operator()(QNetworkReply* reply) const { reply->deleteLater(); }
  };

  void progress() { last_ = Clock::now(); }

  void end(const Status& why) {
    if (problem_) problem_ = why;
    reply_->abort();
  }

  void watch() {
    if (cancel_.cancelled()) return end(Error{"cancelled"});
    const bool isUpload = reply_->operation() == QNetworkAccessManager::PostOperation;
    const seconds limit = !hasConnection_ ? connectTime : isUpload ? silenceAfterUpload : silenceTime;
    if (Clock::now() - last_ < limit) return;
    end(says("does not answer within " + std::to_string(limit.count()) + " s" +
             (hasConnection_ ? "" : ": is the address right, and does a firewall let it pass?")));
  }

  // The pin says more than authorities do.
  void judge(const QList<QSslError>& doubts) {
    if (archive_.tls && !archive_.tls->pin.empty()) {
      const std::string pin = QByteArray::fromStdString(archive_.tls->pin).toLower().toStdString();
      const std::string own = sha256Of(reply_->sslConfiguration().peerCertificate());
      if (own != pin) return end(says("has another certificate than the pinned one: its SHA-256 is " + own));
      reply_->ignoreSslErrors();
    } else if (!doubts.isEmpty()) {
      const std::string by = archive_.tls && !archive_.tls->ca.empty() ? archive_.tls->ca : "this machine";
      const std::string why = doubts.front().errorString().toStdString();
      end(says("has a certificate that " + by +
               " does not vouch for: " + why.substr(0, why.find_last_not_of('.') + 1)));
    }
  }

  WebAnswer answer() const {
    WebAnswer a;
    a.status = reply_->attribute(QNetworkRequest::HttpStatusCodeAttribute).toInt();
    a.contentType = reply_->rawHeader("Content-Type").toStdString();
    a.isPart = reply_->rawHeader("Warning").trimmed().startsWith("299");
    a.isMeasured = reply_->hasRawHeader("Content-Length") || reply_->hasRawHeader("Transfer-Encoding");
    return a;
  }

  // Qt's event loop lets no exception through.
  void take() {
    try {
      takeAll();
    } catch (const std::bad_alloc&) {
      end(says("sends more than there is memory for"));
    }
  }

  void takeAll() {
    if (!problem_) return;
    const WebAnswer now = answer();
    while (problem_ && reply_->bytesAvailable() > 0) {
      const QByteArray bytes = reply_->read(bytesAtOnce);
      progress();
      if (!hasBody(now.status)) continue;
      if (now.contentType.starts_with("text/html"))
        return end(says("answers with a web page: is the URL that of its DICOMweb services?"));
      const Status taken = onBody_(now, std::string_view(bytes.constData(), std::size_t(bytes.size())));
      if (!taken) end(taken);
    }
  }

  Outcome outcome() const {
    Outcome out;
    out.answer = answer();
    out.problem = problem_;
    const QByteArray target = reply_->rawHeader("Location");
    if (isRedirect(out.answer.status) && !target.isEmpty())
      out.redirect = reply_->url().resolved(QUrl::fromEncoded(target));
    out.pause = seconds(reply_->rawHeader("Retry-After").toInt());
    // What cannot be unpacked is an error of a good status, too.
    const bool isCut =
        out.answer.status >= 200 && out.answer.status < 300 && reply_->error() != QNetworkReply::NoError;
    if (problem_ && (out.answer.status == 0 || isCut)) out.problem = connectionFailure();
    return out;
  }

  Error connectionFailure() const {
    switch (reply_->error()) {
      case QNetworkReply::HostNotFoundError:
        return says("cannot be found: no address is known for this host");
      case QNetworkReply::ConnectionRefusedError:
        return says("cannot be reached: Connection refused");
      case QNetworkReply::RemoteHostClosedError:
        return says("ended the connection");
      case QNetworkReply::SslHandshakeFailedError:
        return says("does not agree on TLS: " + reply_->errorString().toStdString());
      default:
        return says("fails: " + reply_->errorString().toStdString());
    }
  }

  Error says(const std::string& predicate) const {
    return {"The archive \"" + archive_.name + "\" (" + archive_.url + ") " + predicate + "."};
  }

  const Archive& archive_;
  const CancelToken& cancel_;
  const WebExchange::OnBody& onBody_;
  std::unique_ptr<QNetworkReply, Deleter> reply_;
  Clock::time_point last_;
  bool hasConnection_ = false;
  Status problem_;
};

Result<QSslConfiguration> tlsConfiguration(const TlsSettings& tls) {
  QSslConfiguration configuration = QSslConfiguration::defaultConfiguration();
  if (!tls.ca.empty()) {
    const auto trusted = QSslCertificate::fromPath(QString::fromStdString(tls.ca));
    if (trusted.isEmpty()) return Error{tls.ca + " holds no certificate that can be read."};
    configuration.setCaCertificates(trusted);
  }
  if (tls.certificate.empty()) return configuration;
  const auto own = QSslCertificate::fromPath(QString::fromStdString(tls.certificate));
  if (own.isEmpty()) return Error{tls.certificate + " is no certificate that can be read."};
  configuration.setLocalCertificateChain(own);
  QFile file(QString::fromStdString(tls.key));
  const QByteArray pem = file.open(QFile::ReadOnly) ? file.read(1 << 20) : QByteArray();
  for (const QSsl::KeyAlgorithm algorithm : {QSsl::Rsa, QSsl::Ec}) {
    const QSslKey key(pem, algorithm);
    if (key.isNull()) continue;
    configuration.setPrivateKey(key);
    return configuration;
  }
  return Error{tls.key + " is no private key that can be read."};
}

}  // namespace

// Qt's network needs an event loop. It runs on a thread of its own, so that no other work of the caller's
// thread is done meanwhile.
struct WebExchange::Private {
  Private(const Archive& to, const CancelToken& cancelToken) : archive(to), cancel(cancelToken) {
    needQtApplication();
    context.moveToThread(&thread);
    thread.start();
  }
  ~Private() {
    if (thread.isRunning()) onThread([&] { manager.reset(); });
    thread.quit();
    thread.wait();
  }

  template <class Work>
  void onThread(Work work) {
    QMetaObject::invokeMethod(&context, work, Qt::BlockingQueuedConnection);
  }

  // Finds out how we identify ourselves, once.
  Status authorize(bool again) {
    const bool isToken = !archive.tokenCommand.empty();
    if (!isToken && archive.user.empty()) return {};
    if (!authorization.isEmpty() && !again) return {};
    const auto secret = outputOf(isToken ? archive.tokenCommand : archive.passwordCommand, cancel);
    if (!secret)
      return Error{"The " + std::string(isToken ? "tokenCommand" : "passwordCommand") + " of the archive \"" +
                   archive.name + "\" " + secret.message()};
    const QByteArray bytes = QByteArray::fromStdString(*secret);
    authorization = isToken ? "Bearer " + bytes
                            : "Basic " + (QByteArray::fromStdString(archive.user) + ":" + bytes).toBase64();
    return {};
  }

  Result<QNetworkRequest> requestFor(const QUrl& url, const WebRequest& request) {
    QNetworkRequest r(url);
    r.setAttribute(QNetworkRequest::RedirectPolicyAttribute, QNetworkRequest::ManualRedirectPolicy);
    r.setAttribute(QNetworkRequest::Http2AllowedAttribute, false);
    r.setAttribute(QNetworkRequest::CookieLoadControlAttribute, QNetworkRequest::Manual);
    r.setAttribute(QNetworkRequest::CookieSaveControlAttribute, QNetworkRequest::Manual);
    r.setRawHeader("Accept", QByteArray::fromStdString(request.accept));
    if (!request.isCompressible) r.setRawHeader("Accept-Encoding", "identity");
    if (!authorization.isEmpty()) r.setRawHeader("Authorization", authorization);
    if (archive.tls) {
      auto configuration = tlsConfiguration(*archive.tls);
      if (!configuration) return configuration.error();
      r.setSslConfiguration(*configuration);
    }
    return r;
  }

  Outcome once(const QUrl& url, const WebRequest& request, const OnBody& onBody) {
    Outcome failed;
    if (Status s = authorize(false); !s) return failed.problem = s, failed;
    auto r = requestFor(url, request);
    if (!r) return failed.problem = r.error(), failed;
    if (!manager) manager = std::make_unique<QNetworkAccessManager>();
    if (!request.body) return Request(archive, cancel, onBody).run(manager->get(*r));
    std::unique_ptr<QHttpMultiPart> body = request.body();
    r->setHeader(
        QNetworkRequest::ContentTypeHeader,
        QByteArray("multipart/related; type=\"application/dicom\"; boundary=\"") + body->boundary() + '"');
    QNetworkReply* reply = manager->post(*r, body.get());
    body.release()->setParent(reply);
    return Request(archive, cancel, onBody).run(reply);
  }

  Status pause(seconds asked, int tries) const {
    const auto end = Clock::now() + std::min(std::max(asked, seconds(1 << (tries - 1))), mostTimeOfPause);
    while (Clock::now() < end) {
      if (cancel.cancelled()) return Error{"cancelled"};
      std::this_thread::sleep_for(lookEvery);
    }
    return {};
  }

  Error says(const std::string& predicate) const {
    return {"The archive \"" + archive.name + "\" (" + archive.url + ") " + predicate + "."};
  }

  Error unauthorized() const {
    if (!archive.tokenCommand.empty()) return says("does not accept the token of \"tokenCommand\" (401)");
    if (!archive.user.empty()) return says("does not accept user and password (401)");
    return says("wants a password (401): give \"user\" and \"passwordCommand\", or \"tokenCommand\"");
  }

  Result<WebAnswer> perform(const WebRequest& request, const OnBody& onBody) {
    QUrl url = QUrl::fromEncoded(QByteArray::fromStdString(archive.url + request.target));
    int tries = 0, redirects = 0;
    bool isRenewed = archive.tokenCommand.empty();
    for (;;) {
      const Outcome out = once(url, request, onBody);
      if (!out.problem) return out.problem.error();
      const int status = out.answer.status;
      if (isRedirect(status) && out.redirect.isValid()) {
        if (!isSameHost(url, out.redirect))
          return says("redirects to " + placeOf(out.redirect) + ", which is refused: correct \"url\"");
        if (++redirects > mostRedirects) return says("redirects in a circle");
        url = out.redirect;
      } else if (status == 401) {
        if (std::exchange(isRenewed, true)) return unauthorized();
        if (Status s = authorize(true); !s) return s.error();
      } else if (status == 403) {
        return says("does not allow this (403)");
      } else if (isBusy(status)) {
        if (++tries == mostTries) return out.answer;
        if (Status s = pause(out.pause, tries); !s) return s.error();
      } else {
        return out.answer;
      }
    }
  }

  const Archive archive;
  const CancelToken cancel;
  QThread thread;
  QObject context;
  std::unique_ptr<QNetworkAccessManager> manager;
  QByteArray authorization;
};

WebExchange::WebExchange(const Archive& archive, const CancelToken& cancel)
    : p_(std::make_unique<Private>(archive, cancel)) {}
WebExchange::~WebExchange() = default;

Result<WebAnswer> WebExchange::send(const WebRequest& request, const OnBody& onBody) {
  Result<WebAnswer> answer = Error{};
  if (!p_->thread.isRunning()) return p_->says("cannot be asked, as the system starts no more threads");
  p_->onThread([&] {
    try {
      answer = p_->perform(request, onBody);
    } catch (const std::bad_alloc&) {
      answer = p_->says("cannot be asked, as there is too little memory");
    }
  });
  return answer;
}

Error WebExchange::says(const std::string& predicate) const { return p_->says(predicate); }

}  // namespace volumen
