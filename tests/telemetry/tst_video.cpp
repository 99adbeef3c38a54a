// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of videos: numbers that are painted into clips of ffmpeg are read back at a hundred
// places, and compared with what ffmpeg itself shows there.
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <telemetry/video/video_file.h>

#include "../support/numbered_clip.h"

namespace tst_video {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using Clip = tests::NumberedClip;

namespace {

constexpr int clipLength = 150;  // pictures

int greyOf(std::uint32_t pixel) {
  return static_cast<int>(((pixel >> 16 & 255) + (pixel >> 8 & 255) + (pixel & 255)) / 3);
}

int numberOf(const VideoPicture& picture) {
  return Clip::numberIn(picture.width, picture.height, [&](int x, int y) {
    return greyOf(picture.pixels[static_cast<std::size_t>(y * picture.width + x)]);
  });
}

/// Times and numbers of a clip's pictures as ffprobe and ffmpeg give them.
struct Truth {
  std::vector<double> times;  // s since the first
  std::vector<int> numbers;
  QByteArray grey;  // all pictures
};

Truth truthOf(const QString& path, int width, int height) {
  Truth truth;
  QProcess probe;
  probe.start("ffprobe", {"-v", "error", "-select_streams", "v:0", "-show_entries",
                          "frame=pts_time", "-of", "csv=p=0", path});
  if (!probe.waitForFinished(60'000)) return {};
  for (const QByteArray& line : probe.readAllStandardOutput().split('\n')) {
    if (!line.isEmpty()) truth.times.push_back(line.split(',').first().toDouble());
  }
  for (const double first = truth.times.empty() ? 0.0 : truth.times.front();
       double& time : truth.times) {
    time -= first;
  }
  truth.grey = Clip::ffmpeg({"-i", path, "-vsync", "passthrough", "-f", "rawvideo", "-pix_fmt",
                             "gray", "pipe:1"})
                   .value_or(QByteArray());
  for (qsizetype at = 0; at + width * height <= truth.grey.size(); at += width * height) {
    truth.numbers.push_back(Clip::numberIn(width, height, [&](int x, int y) {
      return static_cast<int>(static_cast<unsigned char>(truth.grey[at + y * width + x]));
    }));
  }
  return truth;
}

VideoFile opened(const QString& path) {
  auto video = VideoFile::open(path.toStdString());
  if (!video) qFatal("%s", video.error().text().c_str());
  return std::move(*video);
}

}  // namespace

class TestVideo : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString path(const QString& name) const { return m_folder.filePath(name); }

  void needClip(const QString& name, const QStringList& how) {
    if (!QFile::exists(path(name))) QVERIFY(Clip::make(path(name), clipLength, how));
  }

 private slots:
  void initTestCase() {
    if (!Clip::canBeMade()) QSKIP("ffmpeg is not installed");
  }

  void everySeekShowsItsPicture_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QStringList>("how");
    const QStringList b{"-c:v",    "libx264", "-pix_fmt",     "yuv420p",
                        "-preset", "fast",    "-x264-params", "keyint=40:bframes=3:b-adapt=0"};
    const QStringList open{
        "-c:v",         "libx264",
        "-pix_fmt",     "yuv420p",
        "-x264-params", "keyint=25:min-keyint=25:bframes=3:b-adapt=0:scenecut=0:open-gop=1"};
    QTest::newRow("H.264 with B-frames") << "b.mp4" << b;
    QTest::newRow("open GOPs, MPEG-TS, from 1.4 s") << "open.ts" << open;
    QTest::newRow("open GOPs, MP4") << "open.mp4" << open;
    QTest::newRow("variable frame rate")
        << "vfr.mkv"
        << b + QStringList{"-vf", "settb=1/90000,setpts=(N/30+N*N/2500)/TB", "-vsync", "vfr"};
    QTest::newRow("variable frame rate, MP4")
        << "vfr.mp4" << b + QStringList{"-vf",
                                        "settb=1/90000,setpts=(N/30+N*N/2500)/TB",
                                        "-vsync",
                                        "vfr",
                                        "-video_track_timescale",
                                        "90000"};
    QTest::newRow("fragmented") << "fragmented.mp4"
                                << b + QStringList{"-movflags", "frag_keyframe+empty_moov"};
    QTest::newRow("key frames only") << "mjpeg.mkv" << QStringList{"-c:v", "mjpeg", "-q:v", "2"};
    QTest::newRow("MPEG-4, AVI") << "old.avi" << QStringList{"-c:v", "mpeg4", "-q:v", "2"};
    QTest::newRow("VP9") << "vp9.webm"
                         << QStringList{"-c:v",      "libvpx-vp9", "-deadline", "realtime",
                                        "-cpu-used", "8",          "-b:v",      "2M"};
  }
  void everySeekShowsItsPicture() {
    QFETCH(QString, name);
    QFETCH(QStringList, how);
    needClip(name, how);
    const Truth truth = truthOf(path(name), Clip::width, Clip::height);
    QCOMPARE(truth.numbers.size(), std::size_t{clipLength});
    auto video = opened(path(name));
    QCOMPARE(video.times().size(), truth.times.size());
    QCOMPARE(video.info().width, Clip::width);
    QCOMPARE(video.info().height, Clip::height);
    for (std::size_t i = 0; i < truth.times.size(); ++i) {
      QVERIFY2(std::abs(video.times()[i] - truth.times[i]) < 1e-5, qPrintable(QString::number(i)));
    }
    std::mt19937 random(7);
    std::size_t last = 0;
    for (int seek = 0; seek < 100; ++seek) {
      // Single steps forwards and backwards among jumps.
      const std::size_t index = seek % 5 == 3   ? std::min<std::size_t>(last + 1, clipLength - 1)
                                : seek % 5 == 4 ? last - std::min<std::size_t>(last, 2)
                                                : random() % clipLength;
      // In the middle of the time for which it is shown.
      const double until =
          index + 1 < truth.times.size() ? truth.times[index + 1] : truth.times[index] + 0.02;
      const std::size_t shown = video.indexAt((truth.times[index] + until) / 2);
      QCOMPARE(shown, index);
      QCOMPARE(video.indexAt(truth.times[index]), index);
      const auto picture = video.picture(shown);
      QVERIFY2(picture, picture ? "" : picture.error().text().c_str());
      QCOMPARE(numberOf(*picture), truth.numbers[index]);
      QCOMPARE(numberOf(*picture), static_cast<int>(index));
      QCOMPARE(picture->index, index);
      last = index;
    }
  }

  /// The times that `setpts` was told, not those that another program read.
  void timesOfAVariableRateAreThoseOfItsFormula() {
    needClip("paper.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "2", "-vf",
                           "settb=1/90000,setpts=(N/30+N*N/2500)/TB", "-vsync", "vfr",
                           "-enc_time_base", "1/90000", "-video_track_timescale", "90000"});
    const auto video = opened(path("paper.mp4"));
    QCOMPARE(video.times().size(), std::size_t{clipLength});
    for (std::size_t i = 0; i < video.times().size(); ++i) {
      const double n = static_cast<double>(i);
      QVERIFY2(std::abs(video.times()[i] - (n / 30 + n * n / 2500)) <= 1.5 / 90'000,
               qPrintable(QStringLiteral("%1: %2").arg(i).arg(video.times()[i], 0, 'f', 6)));
    }
    QCOMPARE(video.info().duration > video.times().back(), true);
  }

  void picturesForwardsDecodeEachOnce() {
    needClip("b.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-g", "150", "-bf", "3"});
    auto video = opened(path("b.mp4"));
    int packets = 0;
    const auto count = [&packets](double) {
      ++packets;
      return true;
    };
    for (std::size_t i = 0; i < clipLength; ++i) {
      const auto picture = video.picture(i, 0, 0, count);
      QVERIFY(picture);
      QCOMPARE(numberOf(*picture), static_cast<int>(i));
    }
    QVERIFY2(packets <= clipLength + 2, qPrintable(QString::number(packets)));
    // All of them are kept, because they are small.
    packets = 0;
    for (std::size_t i = clipLength; i-- > 0;) {
      QCOMPARE(numberOf(*video.picture(i, 0, 0, count)), static_cast<int>(i));
    }
    QCOMPARE(packets, 0);
  }

  /// A phone stores pictures as its sensor lies, and says how they are turned.
  void rotatedVideoIsUpright_data() {
    QTest::addColumn<int>("degrees");
    for (const int degrees : {90, 180, 270}) QTest::addRow("%d", degrees) << degrees;
  }
  void rotatedVideoIsUpright() {
    QFETCH(int, degrees);
    needClip("plain.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "30"});
    const QString turned = path(QStringLiteral("turned%1.mp4").arg(degrees));
    // Since FFmpeg 6 the metadata is ignored, and before it there was no such option.
    const QString angle = QString::number(degrees);
    const bool isMade =
        Clip::ffmpeg({"-display_rotation", angle, "-i", path("plain.mp4"), "-c", "copy", turned}) ||
        Clip::ffmpeg(
            {"-i", path("plain.mp4"), "-c", "copy", "-metadata:s:v", "rotate=" + angle, turned});
    QVERIFY(isMade);
    auto video = opened(turned);
    const bool lies = degrees != 180;
    const int width = lies ? Clip::height : Clip::width, height = lies ? Clip::width : Clip::height;
    QCOMPARE(video.info().width, width);
    QCOMPARE(video.info().height, height);
    QVERIFY(video.info().rotation != 0);
    // ffmpeg turns pictures upright by itself.
    const Truth truth = truthOf(turned, width, height);
    const qsizetype size = qsizetype{width} * height;
    QCOMPARE(truth.grey.size(), size * clipLength);
    std::mt19937 random(11);
    for (int seek = 0; seek < 100; ++seek) {
      const std::size_t index = random() % clipLength;
      const auto picture = video.picture(index);
      QVERIFY(picture);
      double difference = 0.0;
      for (qsizetype p = 0; p < size; ++p) {
        const int theirs =
            static_cast<unsigned char>(truth.grey[static_cast<qsizetype>(index) * size + p]);
        difference += std::abs(greyOf(picture->pixels[static_cast<std::size_t>(p)]) - theirs);
      }
      QVERIFY2(difference / static_cast<double>(size) < 12.0,
               qPrintable(QString::number(difference / static_cast<double>(size))));
      // Turned back, the number is there.
      const bool clockwise = video.info().rotation == 90;
      QCOMPARE(Clip::numberIn(
                   Clip::width, Clip::height,
                   [&](int x, int y) {
                     const int px = !lies ? width - 1 - x : clockwise ? width - 1 - y : y;
                     const int py = !lies ? height - 1 - y : clockwise ? x : height - 1 - x;
                     return greyOf(picture->pixels[static_cast<std::size_t>(py * width + px)]);
                   }),
               static_cast<int>(index));
    }
  }

  /// Editors cut without encoding again: what lies before the cut is decoded and not shown.
  void aCutVideoBeginsAtTheCut() {
    needClip("plain.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "30"});
    const QString cut = path("cut.mp4");
    QVERIFY(Clip::ffmpeg({"-ss", "1.64", "-i", path("plain.mp4"), "-c", "copy", cut}));
    const Truth truth = truthOf(cut, Clip::width, Clip::height);
    auto video = opened(cut);
    QCOMPARE(video.times().size(), truth.numbers.size());
    for (std::size_t i = truth.numbers.size(); i-- > 0;) {
      QCOMPARE(numberOf(*video.picture(i)), truth.numbers[i]);
    }
    QVERIFY(truth.numbers.front() >= 40);
  }

  void coloursAreThoseOfTheVideo_data() {
    QTest::addColumn<QStringList>("how");
    const QStringList coded{"-c:v", "libx264", "-qp", "1", "-pix_fmt"};
    QTest::newRow("BT.601") << QStringList{"-vf", "scale=out_color_matrix=bt601:out_range=tv"} +
                                   coded + QStringList{"yuv444p", "-colorspace", "smpte170m"};
    QTest::newRow("BT.709") << QStringList{"-vf", "scale=out_color_matrix=bt709:out_range=tv"} +
                                   coded + QStringList{"yuv444p", "-colorspace", "bt709"};
    QTest::newRow("full range") << QStringList{"-vf", "scale=out_color_matrix=bt709:out_range=pc"} +
                                       coded +
                                       QStringList{"yuv444p", "-colorspace", "bt709",
                                                   "-color_range", "pc"};
  }
  void coloursAreThoseOfTheVideo() {
    QFETCH(QStringList, how);
    const QString file = path(QStringLiteral("red.mp4"));
    QVERIFY(Clip::ffmpeg(
        QStringList{"-f", "lavfi", "-i", "color=0xf02820:s=64x64:d=0.2", "-pix_fmt", "rgb24"} +
        how + QStringList{file}));
    auto video = opened(file);
    const auto picture = video.picture(0);
    QVERIFY(picture);
    const std::uint32_t pixel = picture->pixels[64 * 32 + 32];
    QVERIFY2(std::abs(static_cast<int>(pixel >> 16 & 255) - 0xf0) <= 4 &&
                 std::abs(static_cast<int>(pixel >> 8 & 255) - 0x28) <= 4 &&
                 std::abs(static_cast<int>(pixel & 255) - 0x20) <= 4,
             qPrintable(QString::number(pixel, 16)));
  }

  void largePicturesAreScaledDownOnly() {
    needClip("plain.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "30"});
    auto video = opened(path("plain.mp4"));
    const auto small = video.picture(99, 81, 1000);
    QVERIFY(small);
    QCOMPARE(small->width, 81);
    QCOMPARE(small->height, 49);  // 96 × 81/160 = 48.6
    QCOMPARE(numberOf(*small), 99);
    QCOMPARE(video.picture(99, 4000, 4000)->width, Clip::width);
  }

  void theCameraSaysWhenItBegan() {
    const QString file = path("created.mp4");
    QVERIFY(
        Clip::make(file, 5, {"-c:v", "mpeg4", "-metadata", "creation_time=2024-07-19T13:05:30Z"}));
    const auto video = opened(file);
    QVERIFY(video.info().created);
    // `date -u -d 2024-07-19T13:05:30Z +%s`
    QCOMPARE(video.info().created->time_since_epoch().count(), 1'721'394'330'000'000'000LL);
  }

  void badFilesAreRefused() {
    const auto write = [this](const char* name, const QByteArray& bytes) {
      QFile file(path(name));
      file.open(QIODevice::WriteOnly);
      file.write(bytes);
      return path(name).toStdString();
    };
    QCOMPARE(VideoFile::open(path("none.mp4").toStdString()).error().code, ErrorCode::NotFound);
    QCOMPARE(VideoFile::open(m_folder.path().toStdString()).error().code, ErrorCode::Unsupported);
    QVERIFY(!VideoFile::open(write("empty.mp4", {})));
    QVERIFY(!VideoFile::open(write("text.mp4", QByteArray("no video\n").repeated(1000))));
    QVERIFY(!VideoFile::open(write("list.m3u8", "#EXTM3U\n#EXTINF:1,\nhttp://127.0.0.1:9/a.ts\n")));
    QVERIFY(Clip::ffmpeg({"-f", "lavfi", "-i", "sine=d=1", path("sound.wav")}));
    QCOMPARE(VideoFile::open(path("sound.wav").toStdString()).error().code, ErrorCode::Unsupported);
    needClip("raw.h264", {"-c:v", "libx264", "-pix_fmt", "yuv420p"});
    const auto raw = VideoFile::open(path("raw.h264").toStdString());
    QVERIFY(!raw && raw.error().code == ErrorCode::Unsupported);
    QVERIFY2(raw.error().message.find("Convert it to MP4") != std::string::npos,
             raw.error().message.c_str());
    // The table of an MP4 is at its end.
    needClip("plain.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "30"});
    QFile whole(path("plain.mp4"));
    QVERIFY(whole.open(QIODevice::ReadOnly));
    QVERIFY(!VideoFile::open(write("half.mp4", whole.readAll().left(whole.size() / 2))));
    auto video = opened(path("plain.mp4"));
    QCOMPARE(video.picture(clipLength).error().code, ErrorCode::InvalidArgument);
    QCOMPARE(
        VideoFile::open(path("plain.mp4").toStdString(), [](double) { return false; }).error().code,
        ErrorCode::Conflict);
  }

  /// What can be decoded is shown, and the number of a picture is never a wrong one.
  void damagedFilesGiveWhatIsLeft() {
    needClip("open.ts", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-x264-params",
                         "keyint=25:min-keyint=25:bframes=3:b-adapt=0:scenecut=0:open-gop=1"});
    QFile file(path("open.ts"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray whole = file.readAll();
    std::mt19937 random(3);
    for (int damage = 0; damage < 8; ++damage) {
      QByteArray bytes = whole.left(whole.size() * (damage + 4) / 12);
      for (int hit = 0; hit < 12 * damage; ++hit) {
        bytes[static_cast<qsizetype>(random() % static_cast<std::size_t>(bytes.size()))] =
            static_cast<char>(random());
      }
      QFile damaged(path("damaged.ts"));
      QVERIFY(damaged.open(QIODevice::WriteOnly));
      damaged.write(bytes);
      damaged.close();
      auto video = VideoFile::open(damaged.fileName().toStdString());
      if (!video) continue;
      QVERIFY(video->times().size() <= std::size_t{clipLength} + 1);
      for (std::size_t i = 0; i < video->times().size(); i += 7) {
        const auto picture = video->picture(video->times().size() - 1 - i);
        if (!picture) QVERIFY(!picture.error().message.empty());
        // Only the end is missing, and may be cut within a picture.
        if (damage == 0 && i > 0) {
          QVERIFY(picture && numberOf(*picture) == static_cast<int>(picture->index));
        }
      }
    }
  }
};

PITCHBOARD_TEST(TestVideo)

}  // namespace tst_video

#include "tst_video.moc"
