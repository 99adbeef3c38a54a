// SPDX-License-Identifier: GPL-3.0-or-later
// The checksum of files against zlib's, of every length, place and continuation.
#include <zlib.h>

#include <QtTest>
#include <random>
#include <string>

#include <telemetry/mcap/crc32.h>

namespace tst_crc32 {

using namespace pitchboard::telemetry;

namespace {

std::string randomBytes(std::size_t count) {
  std::mt19937 random(48);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() & 0xffU);
  return bytes;
}

std::uint32_t ofZlib(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

class TestCrc32 : public QObject {
  Q_OBJECT

 private slots:
  void publishedCheckValue() {
    QCOMPARE(extendedCrc(0, "123456789"), 0xcbf43926U);
    QCOMPARE(extendedCrc(0, {}), 0U);
  }

  void everyLengthAndPlace() {
    const std::string bytes = randomBytes(600);
    for (std::size_t at = 0; at < 17; ++at) {
      for (std::size_t size = 0; size < 500; ++size) {
        const auto part = std::string_view(bytes).substr(at, size);
        const std::uint32_t before = size % 3 == 0 ? 0U : 0x9e37'79b9U * static_cast<unsigned>(at);
        if (extendedCrc(before, part) == ofZlib(before, part)) continue;
        QFAIL(qPrintable(QString("%1 bytes from %2 on").arg(size).arg(at)));
      }
    }
  }

  void piecesAreThatOfTheWhole() {
    const std::string bytes = randomBytes(1 << 20);
    const std::uint32_t whole = extendedCrc(0, bytes);
    QCOMPARE(whole, ofZlib(0, bytes));
    std::uint32_t crc = 0;
    for (std::size_t at = 0, size = 1; at < bytes.size(); at += size, size = size * 3 % 1009) {
      crc = extendedCrc(crc, std::string_view(bytes).substr(at, size));
    }
    QCOMPARE(crc, whole);
  }
};

PITCHBOARD_TEST(TestCrc32)

}  // namespace tst_crc32

#include "tst_crc32.moc"
