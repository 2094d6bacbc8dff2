#pragma once

#include <QRgb>
#include <array>
#include <cmath>
#include <cstdint>

namespace volumen {

/// Blends a colour with opacity `part` (0 to 1) over other colours, channel by channel.
class ColourMix {
 public:
  ColourMix(QRgb over, double part) {
    for (int under = 0; under < 256; ++under) {
      const auto mixed = [&](int channel) {
        return std::uint8_t(std::lround((1 - part) * under + part * channel));
      };
      red_[std::size_t(under)] = mixed(qRed(over));
      green_[std::size_t(under)] = mixed(qGreen(over));
      blue_[std::size_t(under)] = mixed(qBlue(over));
    }
  }
  QRgb operator()(QRgb under) const {
    return qRgb(red_[under >> 16 & 255], green_[under >> 8 & 255], blue_[under & 255]);
  }

 private:
  std::array<std::uint8_t, 256> red_, green_, blue_;
};

}  // namespace volumen
