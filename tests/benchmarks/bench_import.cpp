// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a recording of ROS 2 becomes a session, and how much memory that takes:
//   bench_import make FILE MEGABYTES   writes one: joint states at 1 kHz, poses, tf, and images in
//                                      between, which are 70 % of it; chunks are not compressed,
//                                      and there is a summary, as rosbag2 writes them
//   bench_import run FILE              imports it, and prints seconds, MB/s and peak memory
// decode_recording.mjs decodes the same messages with the official packages; import_speed.py
// compares the two.
#include <sys/resource.h>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include <robotlink/import/import_session.h>

namespace {

using namespace pitchboard;

const std::string separator(80, '=');
const std::string headerText =
    separator + "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
const std::string poseText =
    separator + "\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n" + separator +
    "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\n" + "float64 z\n" + separator +
    "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "float64 w\n";

/// CDR, little-endian, version 1.
class Cdr {
 public:
  Cdr() : m_bytes("\0\1\0\0", 4) {}
  template <class T>
  void put(T value) {
    while ((m_bytes.size() - 4) % sizeof(T) != 0) m_bytes += '\0';
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    m_bytes.append(bytes, sizeof(T));
  }
  void text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    m_bytes += text;
    m_bytes += '\0';
  }
  void header(std::uint64_t time, const std::string& frame) {
    put(static_cast<std::int32_t>(time / 1'000'000'000));
    put(static_cast<std::uint32_t>(time % 1'000'000'000));
    text(frame);
  }
  void numbers(std::size_t count, double first) {
    put(static_cast<std::uint32_t>(count));
    for (std::size_t i = 0; i < count; ++i) put(first + static_cast<double>(i) / 64.0);
  }
  std::string& bytes() { return m_bytes; }

 private:
  std::string m_bytes;
};

std::string jointState(std::uint64_t time, double phase) {
  constexpr std::size_t joints = 20;
  Cdr out;
  out.header(time, "");
  out.put(static_cast<std::uint32_t>(joints));
  for (std::size_t i = 0; i < joints; ++i) out.text("joint_number_" + std::to_string(i));
  for (int list = 0; list < 3; ++list) out.numbers(joints, std::sin(phase + list));
  return std::move(out.bytes());
}

std::string pose(std::uint64_t time, double phase) {
  Cdr out;
  out.header(time, "map");
  for (const double value : {std::sin(phase), std::cos(phase), 0.0, 0.0, 0.0, 0.0, 1.0}) {
    out.put(value);
  }
  for (int i = 0; i < 36; ++i) out.put(i % 7 == 0 ? 0.01 : 0.0);
  return std::move(out.bytes());
}

std::string transforms(std::uint64_t time, double phase) {
  Cdr out;
  out.put(std::uint32_t{2});
  for (const char* child : {"odom", "base_link"}) {
    out.header(time, std::string(child) == "odom" ? "map" : "odom");
    out.text(child);
    for (const double value : {std::sin(phase), 0.5, 0.0, 0.0, 0.0, 0.0, 1.0}) out.put(value);
  }
  return std::move(out.bytes());
}

std::string image(std::uint64_t time) {
  Cdr out;
  out.header(time, "camera");
  out.put(std::uint32_t{480});
  out.put(std::uint32_t{640});
  out.put(std::uint32_t{640 * 480 * 3});
  out.bytes().append(640 * 480 * 3, '\x55');
  return std::move(out.bytes());
}

/// Plain chunks; the writer of sessions compresses all of its chunks.
class PlainFile {
 public:
  explicit PlainFile(const char* path) : m_file(std::fopen(path, "wb")) {
    m_out.assign("\x89MCAP0\r\n", 8);
    record(1, text("ros2") + text("bench"));
  }
  ~PlainFile() { std::fclose(m_file); }
  void schema(std::uint16_t id, const std::string& name, const std::string& data) {
    define(packed(3, number(id) + text(name) + text("ros2msg") + text(data)));
    ++m_schemas;
  }
  void channel(std::uint16_t id, const std::string& topic) {
    define(
        packed(4, number(id) + number(id) + text(topic) + text("cdr") + number(std::uint32_t{0})));
  }
  void message(std::uint16_t channel, std::uint64_t time, const std::string& bytes) {
    m_index[channel] += number(time) + number(static_cast<std::uint64_t>(m_chunk.size()));
    if (m_start == 0) m_start = time;
    m_end = time;
    m_first = m_first == 0 ? time : m_first;
    ++m_messages[channel];
    m_chunk +=
        packed(5, number(channel) + number(std::uint32_t{0}) + number(time) + number(time) + bytes);
    if (m_chunk.size() > 786'432) endChunk();
  }
  void endChunk() {
    const auto size = static_cast<std::uint64_t>(m_chunk.size());
    const std::uint64_t begin = m_written;
    record(6, number(m_start) + number(m_end) + number(size) + number(std::uint32_t{0}) + text("") +
                  number(size) + m_chunk);
    const std::uint64_t end = m_written;
    std::string places;
    for (const auto& [channel, entries] : m_index) {
      places += number(channel) + number(m_written);
      record(7, number(channel) + text(entries));
    }
    m_chunkIndex += packed(8, number(m_start) + number(m_end) + number(begin) +
                                  number(end - begin) + text(places) + number(m_written - end) +
                                  text("") + number(size) + number(size));
    ++m_chunks;
    m_index.clear();
    m_chunk.clear();
    m_start = 0;
  }
  void finish() {
    endChunk();
    record(15, number(std::uint32_t{0}));
    std::uint64_t messages = 0;
    std::string counts;
    for (const auto& [channel, count] : m_messages) {
      messages += count;
      counts += number(channel) + number(count);
    }
    const std::uint64_t summary = m_written;
    m_out += m_definitions + m_chunkIndex;
    record(11, number(messages) + number(m_schemas) + number(std::uint32_t{m_schemas}) +
                   number(std::uint32_t{0}) + number(std::uint32_t{0}) + number(m_chunks) +
                   number(m_first) + number(m_end) + text(counts));
    record(2, number(summary) + number(std::uint64_t{0}) + number(std::uint32_t{0}));
    m_out.append("\x89MCAP0\r\n", 8);
    flush();
  }
  std::uint64_t written() const { return m_written; }

 private:
  template <class T>
  static std::string number(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
  }
  static std::string text(const std::string& text) {
    return number(static_cast<std::uint32_t>(text.size())) + text;
  }
  static std::string packed(char op, const std::string& content) {
    return op + number(static_cast<std::uint64_t>(content.size())) + content;
  }
  void define(const std::string& definition) {
    m_chunk += definition;
    m_definitions += definition;
  }
  void record(char op, const std::string& content) {
    m_out += packed(op, content);
    flush();
  }
  void flush() {
    m_written += std::fwrite(m_out.data(), 1, m_out.size(), m_file);
    m_out.clear();
  }
  std::FILE* m_file;
  std::string m_out, m_chunk;
  std::string m_definitions, m_chunkIndex;
  std::map<std::uint16_t, std::string> m_index;
  std::map<std::uint16_t, std::uint64_t> m_messages;
  std::uint64_t m_start = 0, m_end = 0, m_first = 0, m_written = 0;
  std::uint16_t m_schemas = 0;  ///< and as many channels
  std::uint32_t m_chunks = 0;
};

int make(const char* path, double megabytes) {
  PlainFile file(path);
  file.schema(1, "sensor_msgs/msg/JointState",
              "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
              "float64[] effort\n" +
                  headerText);
  file.schema(2, "geometry_msgs/msg/PoseWithCovarianceStamped",
              "std_msgs/Header header\nPoseWithCovariance pose\n" + headerText + separator +
                  "\nMSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n" +
                  poseText);
  file.schema(3, "tf2_msgs/msg/TFMessage",
              "geometry_msgs/TransformStamped[] transforms\n" + separator +
                  "\nMSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring "
                  "child_frame_id\nTransform transform\n" +
                  separator +
                  "\nMSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n" +
                  headerText + separator +
                  "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n" + separator +
                  "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
  file.schema(4, "sensor_msgs/msg/Image",
              "std_msgs/Header header\nuint32 height\nuint32 width\nuint8[] data\n" + headerText);
  file.channel(1, "/joint_states");
  file.channel(2, "/amcl_pose");
  file.channel(3, "/tf");
  file.channel(4, "/camera/image");
  std::uint64_t time = 1'751'364'000'000'000'000;
  std::uint64_t numbers = 0, images = 0;
  for (std::uint64_t tick = 0; static_cast<double>(file.written()) < megabytes * 1e6; ++tick) {
    time += 1'000'000;
    const double phase = static_cast<double>(tick) / 1000.0;
    const auto put = [&](std::uint16_t channel, const std::string& bytes) {
      file.message(channel, time, bytes);
      (channel == 4 ? images : numbers) += bytes.size();
    };
    put(1, jointState(time, phase));
    if (tick % 10 == 0) put(2, pose(time, phase));
    if (tick % 10 == 5) put(3, transforms(time, phase));
    if (images * 3 < numbers * 7) put(4, image(time));
  }
  file.finish();
  return 0;
}

int run(const char* path) {
  const std::string to = (std::filesystem::temp_directory_path() / "bench_import.mcap").string();
  link::ImportOptions options;
  options.ifExists = IfExists::Replace;
  const auto begin = std::chrono::steady_clock::now();
  const auto report = link::importRecordings({path}, to, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  if (!report) {
    std::fprintf(stderr, "error: %s\n", report.error().text().c_str());
    return 2;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  std::printf("%s\n%.3f s, %.0f MB/s, %.0f messages/s, peak memory %ld MB, session %.0f MB\n",
              report->summary().c_str(), took.count(), megabytes / took.count(),
              static_cast<double>(report->messages) / took.count(), usage.ru_maxrss / 1024,
              static_cast<double>(std::filesystem::file_size(to)) / 1e6);
  std::filesystem::remove(to);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "make" && argc == 4) return make(argv[2], std::stod(argv[3]));
  if (what == "run" && argc == 3) return run(argv[2]);
  std::fprintf(stderr, "usage: bench_import make FILE MEGABYTES | run FILE\n");
  return 2;
}
