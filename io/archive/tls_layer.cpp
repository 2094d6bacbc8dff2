#include "io/archive/tls_layer.h"

namespace volumen {

namespace {

Status useCertificate(const TlsSettings& tls, DcmTLSTransportLayer& layer) {
  layer.setPrivateKeyPasswd("");  // a key that needs one is refused: nobody is asked for it
  if (layer.setPrivateKeyFile(tls.key.c_str(), DCF_Filetype_PEM).bad())
    return Error{tls.key + " is no private key that can be read."};
  if (layer.setCertificateFile(tls.certificate.c_str(), DCF_Filetype_PEM).bad())
    return Error{tls.certificate + " is no certificate that can be read."};
  if (!layer.checkPrivateKeyMatchesCertificate())
    return Error{tls.key + " is not the key of " + tls.certificate + "."};
  return {};
}

}  // namespace

Result<std::unique_ptr<DcmTLSTransportLayer>> tlsLayer(const TlsSettings& tls, T_ASC_NetworkRole role) {
  auto layer = std::make_unique<DcmTLSTransportLayer>(role, nullptr, OFTrue);
  layer->setTLSProfile(TSP_Profile_BCP195);
  layer->activateCipherSuites();
  if (!tls.certificate.empty())
    if (Status s = useCertificate(tls, *layer); !s) return s.error();
  if (!tls.ca.empty() && layer->addTrustedCertificateFile(tls.ca.c_str(), DCF_Filetype_PEM).bad())
    return Error{tls.ca + " holds no certificate that can be read."};
  // A pin names the one certificate that is accepted, so authorities need not be asked.
  layer->setCertificateVerification(tls.ca.empty() ? DCV_ignoreCertificate : DCV_requireCertificate);
  return layer;
}

}  // namespace volumen
