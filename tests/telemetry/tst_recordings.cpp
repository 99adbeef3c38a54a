// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of other programs: files that the official packages and ROS 2 itself wrote are read
// value for value, in every form that they can have; what cannot be understood is counted.

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <map>

#include <base/base64.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/recordings/recording.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include "../support/recorded_messages.h"

namespace tst_recordings {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace recorded_messages;

namespace {

struct Contents {
  std::vector<Message> messages;
  std::vector<std::string> notes;
  std::vector<RecordedTopic> topics;
  std::map<std::string, RecordedField> fields;  ///< by topic and path
};

Contents read(const std::vector<std::string>& files) {
  Contents out;
  const auto readers = openRecordings(files);
  if (!readers) {
    out.notes.push_back("error: " + readers.error().text());
    return out;
  }
  for (const auto& reader : *readers) {
    for (auto item = reader->next(); item && *item != RecordedItem::End; item = reader->next()) {
      if (*item != RecordedItem::Message) continue;
      out.messages.push_back(
          messageOf(reader->topics()[reader->message().topic], reader->message()));
      const RecordedMessage& from = reader->message();
      for (const RecordedField& field : from.shape->fields) {
        out.fields[reader->topics()[from.topic].name + " " + field.path] = field;
      }
    }
    for (const std::string& note : reader->notes()) out.notes.push_back(note);
    out.topics.insert(out.topics.end(), reader->topics().begin(), reader->topics().end());
  }
  return out;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool hasNote(const Contents& contents, const char* part) {
  return joined(contents.notes).find(part) != std::string::npos;
}

/// Bytes of CDR, little-endian, version 1. Positions are aligned from behind the head.
class Cdr {
 public:
  explicit Cdr(char code = 1) : m_bytes({'\0', code, '\0', '\0'}) {}
  template <class T>
  Cdr& put(T value) {
    while ((m_bytes.size() - 4) % sizeof(T) != 0) m_bytes += '\0';
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    m_bytes.append(bytes, sizeof(T));
    return *this;
  }
  Cdr& text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    m_bytes += text + '\0';
    return *this;
  }
  /// A member with its number in front; `value` is aligned by itself.
  Cdr& member(std::uint16_t id, const Cdr& value) {
    const std::string bytes = value.m_bytes.substr(4);
    put(std::uint32_t{0});
    m_bytes.resize(m_bytes.size() - 4);
    put(id).put(static_cast<std::uint16_t>(bytes.size()));
    m_bytes += bytes;
    return *this;
  }
  const std::string& bytes() const { return m_bytes; }

 private:
  std::string m_bytes;
};

/// A file of messages that our own writer makes.
struct OwnMessage {
  std::string topic, type, encoding, schemaEncoding, schema, bytes;
};
std::string writeOwn(const QTemporaryDir& folder, const char* name,
                     const std::vector<OwnMessage>& messages) {
  const std::string path = folder.filePath(name).toStdString();
  auto writer = McapWriter::create(path);
  McapChunk chunk;
  std::uint16_t id = 0;
  for (const OwnMessage& message : messages) {
    ++id;
    chunk.add(McapSchema{id, message.type, message.schemaEncoding, message.schema});
    chunk.add(McapChannel{id, id, message.topic, message.encoding, {}});
    chunk.add(McapMessage{id, 0, id, id, message.bytes});
  }
  if (!writer || !writer->writeChunk(chunk) || !writer->finish()) qFatal("cannot write");
  return path;
}

}  // namespace

class TestRecordings : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  void compare(const Contents& got, const std::vector<Message>& wanted) {
    QVERIFY2(!wanted.empty(), "the expectation is empty");
    for (std::size_t i = 0; i < std::min(got.messages.size(), wanted.size()); ++i) {
      if (got.messages[i] == wanted[i]) continue;
      const std::string text = "message " + std::to_string(i) + "\n" + textOf(got.messages[i]) +
                               "\ninstead of\n" + textOf(wanted[i]);
      QFAIL(text.c_str());
    }
    QVERIFY2(got.messages.size() == wanted.size(),
             (std::to_string(got.messages.size()) + " messages, expected " +
              std::to_string(wanted.size()) + "\n" + joined(got.notes))
                 .c_str());
  }

  std::string write(const char* name, const std::string& text) {
    const std::string path = m_folder.filePath(name).toStdString();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

 private slots:
  void officialWriters_data() {
    QTest::addColumn<QString>("name");
    for (const char* name :
         {"ros2_types", "ros2_representations", "ros2_idl", "ros1", "json", "protobuf", "form_lz4",
          "form_zstd", "form_no_chunks", "form_no_summary", "form_unordered"}) {
      QTest::newRow(name) << QString(name);
    }
  }
  void officialWriters() {
    QFETCH(QString, name);
    const Contents got = read({dataPath(name.toStdString() + ".mcap")});
    compare(got, expected(name.toStdString() + ".json"));
    if (name != "protobuf") QVERIFY2(got.notes.empty(), joined(got.notes).c_str());
    if (name == "protobuf") QVERIFY(hasNote(got, "3 values were left out"));  // of type bytes
  }

  void cutOff() {
    const Contents got = read({dataPath("form_cut.mcap")});
    auto wanted = expected("form_cut.json");
    QVERIFY(got.messages.size() > 10 && got.messages.size() < wanted.size());
    wanted.resize(got.messages.size());
    compare(got, wanted);
    QVERIFY2(hasNote(got, "cut off"), joined(got.notes).c_str());
  }

  void splitRecordingIsOne() {
    auto wanted = expected("form_split_0.json");
    const auto more = expected("form_split_1.json");
    wanted.insert(wanted.end(), more.begin(), more.end());
    // In whatever order they are named.
    const Contents got = read({dataPath("form_split_1.mcap"), dataPath("form_split_0.mcap")});
    compare(got, wanted);
    QCOMPARE(got.topics.size(), std::size_t{2});
  }

  void kindsAndUnits() {
    const Contents idl = read({dataPath("ros2_idl.mcap")});
    QCOMPARE(idl.fields.at("/plain volts").unit, std::string("V"));
    QVERIFY(idl.fields.at("/plain on").kind == RecordedKind::Flag);
    QVERIFY(idl.fields.at("/plain mode").kind == RecordedKind::Enumeration);
    QCOMPARE(idl.fields.at("/plain mode").labels.at(6), std::string("KICK"));
    const Contents robot = read({dataPath("protobuf.mcap")});
    QCOMPARE(robot.fields.at("/robot role").labels.at(2), std::string("STRIKER"));
    const Contents walk = read({dataPath("robot_walks.mcap")});
    QCOMPARE(walk.fields.at("/robot3/amcl_pose pose.pose.position.y").unit, std::string("m"));
    QCOMPARE(walk.fields.at("/robot3/joint_states position[left_knee]").unit, std::string("rad"));
    QCOMPARE(walk.fields.at("/robot3/battery_state voltage").unit, std::string("V"));
    QVERIFY(walk.fields.contains("/tf transforms[robot7/odom].transform.translation.x"));
  }

  void imagesAreSkipped() {
    const Contents got = read({dataPath("robot_walks.mcap")});
    QVERIFY2(hasNote(got, "/camera/image (sensor_msgs/Image): 20 messages were left out."),
             joined(got.notes).c_str());
    QCOMPARE(got.notes.size(), std::size_t{1});
  }

  /// Not even their checksum is: whatever is in an image, the rest is there.
  void imagesAreNotRead() {
    std::ifstream in(dataPath("images_between.mcap"), std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto image = bytes.find(std::string(1000, 'U'));
    QVERIFY(image != bytes.npos);
    bytes[image + 500] = 'V';
    const Contents got = read({write("images.mcap", bytes)});
    compare(got, expected("images_between.json"));
    QCOMPARE(got.notes.size(), std::size_t{1});
    QVERIFY2(hasNote(got, "/camera/image (sensor_msgs/Image): 3 messages were left out."),
             joined(got.notes).c_str());
  }

  void recordedByRos2_data() {
    QTest::addColumn<QStringList>("files");
    QTest::addColumn<int>("messages");
    QTest::newRow("types") << QStringList{"cdr_test.mcap"} << 7;
    QTest::newRow("seek") << QStringList{"for_seek.mcap"} << 5;
    QTest::newRow("split") << QStringList{"split_0.mcap", "split_1.mcap", "split_2.mcap"} << 3726;
    QTest::newRow("talker") << QStringList{"talker.mcap"} << 20;
    QTest::newRow("services") << QStringList{"topics_and_services.mcap"} << 13;
    QTest::newRow("types, sqlite3") << QStringList{"cdr_test.db3"} << 7;
  }
  void recordedByRos2() {
    QFETCH(QStringList, files);
    QFETCH(int, messages);
    std::vector<std::string> paths;
    for (const QString& file : files) paths.push_back(dataPath("ros2/" + file.toStdString()));
    const Contents got = read(paths);
    QVERIFY2(got.notes.empty(), joined(got.notes).c_str());
    QCOMPARE(got.messages.size(), static_cast<std::size_t>(messages));
    QVERIFY(std::is_sorted(got.messages.begin(), got.messages.end(),
                           [](const Message& a, const Message& b) { return a.time < b.time; }));
  }

  /// The same recording in both formats.
  void sqliteEqualsMcap() {
    compare(read({dataPath("ros2/cdr_test.db3")}), read({dataPath("ros2/cdr_test.mcap")}).messages);
    const Contents types = read({dataPath("ros2/cdr_test.mcap")});
    QCOMPARE(types.messages.front().values.at("int32_value"), shown(123));
    QCOMPARE(types.fields.size(), std::size_t{13 + 163});
  }

  /// Its definitions are not those of its messages.
  void sqliteWithWrongDefinitions() {
    const Contents got = read({dataPath("ros2/talker.db3")});
    QCOMPARE(got.messages.size(), std::size_t{10});  // those of std_msgs/String
    QVERIFY2(hasNote(got, "/rosout (rcl_interfaces/Log): 10 messages do not match the schema"),
             joined(got.notes).c_str());
    QCOMPARE(got.notes.size(), std::size_t{1});  // the other wrong one has no messages
  }

  /// Neither files nor changes are left beside a database in WAL mode, whatever its name.
  void sqliteLeavesNothingBeside() {
    const QTemporaryDir folder;
    const QString name = QStringLiteral("talker #1 50%25?.db3");
    const QString path = folder.filePath(name);
    QVERIFY(QFile::copy(QString::fromStdString(dataPath("ros2/talker.db3")), path));
    QCOMPARE(read({path.toStdString()}).messages.size(), std::size_t{10});
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{name});
  }

  void textsOfTalker() {
    const Contents got = read({dataPath("ros2/talker.mcap")});
    std::size_t hello = 0;
    for (const Message& message : got.messages) {
      if (message.topic != "/topic") continue;
      QCOMPARE(message.values.at("data"), "Hello, world! " + std::to_string(hello++));
    }
    QCOMPARE(hello, std::size_t{10});
    QVERIFY(got.messages.front().stamp);
  }

  void serviceEvents() {
    const Contents got = read({dataPath("ros2/topics_and_services.mcap")});
    int requests = 0, responses = 0;
    for (const Message& message : got.messages) {
      if (message.topic != "/add_two_ints/_service_event") continue;
      requests += message.values.contains("request[0].a") ? 1 : 0;
      responses += message.values.contains("response[0].sum") ? 1 : 0;
    }
    QVERIFY(requests > 0 && responses > 0);
  }

  /// Whatever is not understood is named with its count, and costs nothing else.
  void unknownAndWrong() {
    const std::string counter = "uint32 count\n";
    const std::string good("\0\1\0\0\7\0\0\0", 8);
    const Contents got = read({writeOwn(
        m_folder, "odd.mcap",
        {{"/good", "a/B", "cdr", "ros2msg", counter, good},
         {"/short", "a/B", "cdr", "ros2msg", counter, good.substr(0, 6)},
         {"/long", "a/B", "cdr", "ros2msg", counter, good + "12345678"},
         {"/flag", "a/B", "cdr", "ros2msg", "bool on\n", good},
         {"/parts", "a/B", "cdr", "ros2msg", "C[] c\n================\nMSG: a/C\nC[4000000000] d\n",
          good},
         {"/text", "a/B", "cdr", "ros2msg", "string s\n",
          std::string("\0\1\0\0\xff\xff\xff\xff", 8)},
         {"/flat", "a/B", "flatbuffer", "flatbuffer", "", good},
         {"/cbor", "a/B", "cbor", "", "", good},
         {"/nosuch", "a/B", "cdr", "ros2msg", "Unknown x\n", good},
         {"/bad_proto", "a.B", "protobuf", "protobuf", "no descriptor", good},
         {"/bad_json", "a.B", "json", "", "", "{\"a\": "},
         {"/code", "a/B", "cdr", "ros2msg", counter, std::string("\0\x77\0\0\7\0\0\0", 8)}})});
    QCOMPARE(got.messages.size(), std::size_t{1});
    QCOMPARE(got.messages.front().values.at("count"), shown(7));
    for (const char* part :
         {"/short (a/B): 1 message does not match", "/long (a/B): 1 message does not match",
          "/flag (a/B): 1 message does not match", "/parts (a/B): 1 message was left out.",
          "/text (a/B): 1 message does not match",
          "/flat (a/B): 1 message was left out. The encoding \"flatbuffer\"",
          "/cbor (a/B): 1 message was left out.", "/nosuch (a/B): 1 message was left out.",
          "/bad_proto (a.B): 1 message was left out.", "/bad_json (a.B): 1 message does not match",
          "/code (a/B): 1 message does not match"}) {
      QVERIFY2(hasNote(got, part), (std::string(part) + "\n" + joined(got.notes)).c_str());
    }
  }

  /// Messages that are laid out as one before take a shorter way. They must not differ from others,
  /// whatever changes: lengths, names, texts, flags that are none.
  void messagesOfOneLayout() {
    const std::string schema =
        "int16 id\nstring[] name\nfloat64[] position\nbool on\nuint8 small\nfloat32[3] v\n"
        "string text\nbuiltin_interfaces/Time stamp\nPart[] parts\n" +
        std::string(80, '=') + "\nMSG: a/Part\nstring name\nint64 value\n" + std::string(80, '=') +
        "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
    struct One {
      std::vector<std::string> names{"hip", "knee"};
      int flag = 1;
      std::string text = "walk";
      std::vector<std::string> parts{"left"};
    };
    std::vector<OwnMessage> messages;
    std::vector<std::map<std::string, std::string>> wanted;
    const auto add = [&](const One& one) {
      const int i = static_cast<int>(messages.size());
      std::map<std::string, std::string> values{{"id", shown(-i)},
                                                {"on", shown(one.flag)},
                                                {"small", shown(i)},
                                                {"text", one.text},
                                                {"stamp", shown(i + 0.25)}};
      Cdr cdr;
      cdr.put(static_cast<std::int16_t>(-i)).put(static_cast<std::uint32_t>(one.names.size()));
      for (const std::string& name : one.names) cdr.text(name);
      cdr.put(static_cast<std::uint32_t>(one.names.size()));
      for (std::size_t n = 0; n < one.names.size(); ++n) {
        cdr.put(i + static_cast<double>(n) / 4);
        values["position[" + one.names[n] + "]"] = shown(i + static_cast<double>(n) / 4);
      }
      cdr.put(static_cast<std::uint8_t>(one.flag)).put(static_cast<std::uint8_t>(i));
      for (int v = 0; v < 3; ++v) {
        cdr.put(static_cast<float>(i + v));
        values["v[" + std::to_string(v) + "]"] = shown(i + v);
      }
      cdr.text(one.text).put(std::int32_t{i}).put(std::uint32_t{250'000'000});
      cdr.put(static_cast<std::uint32_t>(one.parts.size()));
      for (const std::string& part : one.parts) {
        cdr.text(part).put(std::int64_t{i} * -7);
        values["parts[" + part + "].name"] = part;
        values["parts[" + part + "].value"] = shown(i * -7);
      }
      messages.push_back({"/b", "a/B", "cdr", "ros2msg", schema, cdr.bytes()});
      if (one.flag <= 1) wanted.push_back(values);
    };
    for (int i = 0; i < 20; ++i) {
      add({});
      add({.flag = 0, .text = "kick"});
      if (i % 2 == 0) add({.names = {"hip", "foot"}});  // another name, as long as before
      if (i % 3 == 0) add({.parts = {"leg", "foot"}});
      if (i % 4 == 0) add({.text = std::to_string(i) + " steps"});
      if (i % 5 == 0) add({.flag = 2});
      if (i % 5 == 1) add({.parts = {"arms"}});  // a name of the element that is as long
    }
    const Contents got = read({writeOwn(m_folder, "layout.mcap", messages)});
    QVERIFY2(hasNote(got, "/b (a/B): 4 messages do not match"), joined(got.notes).c_str());
    QCOMPARE(got.messages.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto& values = got.messages[i].values;
      if (values != std::map<std::string, std::string>(wanted[i])) {
        for (const auto& [path, value] : wanted[i]) {
          const auto found = values.find(path);
          QVERIFY2(found != values.end(), (std::to_string(i) + " has no " + path).c_str());
          QCOMPARE(found->second, value);
        }
        QCOMPARE(values.size(), wanted[i].size());
      }
      QCOMPARE(got.messages[i].stamp.has_value(), true);
    }
  }

  /// XCDR1 writes mutable types as members with numbers, in any order, and with others between.
  void parameterLists() {
    const std::string schema =
        "module a { @mutable struct Inner { @id(2) short u; @id(9) double w; };\n"
        "@mutable struct B { @id(1) long count; @id(5) double x; @id(7) string word;\n"
        "  @id(8) Inner inner; @id(300) sequence<float> list; };\n"
        "@final struct C { octet first; Inner inner; octet last; }; };\n";
    constexpr std::uint16_t endOfList = 0x3F02, extended = 0x3F01, mustUnderstand = 0x4000;
    Cdr inner;
    inner.member(9, Cdr().put(2.5)).member(2, Cdr().put(std::int16_t{-3}));
    inner.member(endOfList, Cdr());
    Cdr whole(3);
    whole.member(5 | mustUnderstand, Cdr().put(1.25));
    whole.member(77, Cdr().put(std::uint32_t{99}));  // of a later version
    whole.member(7, Cdr().text("kick")).member(8, inner);
    whole.member(extended, Cdr().put(std::uint32_t{300}).put(std::uint32_t{12}));
    whole.put(std::uint32_t{2}).put(0.5F).put(1.5F);
    whole.member(1, Cdr().put(std::int32_t{42})).member(endOfList, Cdr());
    Cdr part(3);  // what is missing is left out
    part.member(1, Cdr().put(std::int32_t{43})).member(endOfList, Cdr());
    Cdr cut(3);
    cut.member(1, Cdr().put(std::int32_t{44}));
    Cdr nested;
    nested.put(std::uint8_t{5});
    nested.member(9, Cdr().put(7.5)).member(2, Cdr().put(std::int16_t{8}));
    nested.member(endOfList, Cdr()).put(std::uint8_t{6});
    const auto message = [&](const char* topic, const char* type, const Cdr& cdr) {
      return OwnMessage{topic, type, "cdr", "omgidl", schema, cdr.bytes()};
    };
    const Contents got =
        read({writeOwn(m_folder, "parameters.mcap",
                       {message("/b", "a::B", whole), message("/b", "a::B", part),
                        message("/b", "a::B", cut), message("/c", "a::C", nested)})});
    QVERIFY2(hasNote(got, "/b (a::B): 1 message does not match"), joined(got.notes).c_str());
    QCOMPARE(got.messages.size(), std::size_t{3});
    const std::map<std::string, std::string> wanted{
        {"count", shown(42)},   {"x", shown(1.25)},      {"word", "kick"},
        {"inner.u", shown(-3)}, {"inner.w", shown(2.5)}, {"list[0]", shown(0.5)},
        {"list[1]", shown(1.5)}};
    QCOMPARE(got.messages[0].values, wanted);
    QCOMPARE(got.messages[1].values, (std::map<std::string, std::string>{{"count", shown(43)}}));
    QCOMPARE(got.messages[2].values, (std::map<std::string, std::string>{{"first", shown(5)},
                                                                         {"inner.u", shown(8)},
                                                                         {"inner.w", shown(7.5)},
                                                                         {"last", shown(6)}}));
  }

  /// A union has the field that its discriminator chooses, or none.
  void unions() {
    const std::string schema =
        "module a { const short many = 12;\n"
        "enum Kind { NONE, BALL, @value(7) GOAL };\n"
        "union Seen switch (Kind) { case BALL: double distance; case GOAL: case a::NONE: long "
        "posts;"
        " };\n"
        "union Size switch (short) { case many: case -2: sequence<octet> list; default: string "
        "word;"
        " };\n"
        "union Mark switch (char) { case 'x': short x; case 'y': float y; };\n"
        "@final struct B { Seen seen; Size size; Mark mark; boolean end; }; };\n";
    const auto message = [&](const Cdr& cdr) {
      return OwnMessage{"/b", "a::B", "cdr", "omgidl", schema, cdr.bytes()};
    };
    Cdr first, second, third;
    first.put(std::int32_t{1}).put(2.5).put(std::int16_t{12}).put(std::uint32_t{2});
    first.put(std::uint8_t{3}).put(std::uint8_t{4}).put('y').put(0.5F).put(std::uint8_t{1});
    second.put(std::int32_t{7}).put(std::int32_t{-4}).put(std::int16_t{5}).text("big");
    second.put('x').put(std::int16_t{9}).put(std::uint8_t{0});
    third.put(std::int32_t{3}).put(std::int16_t{-2}).put(std::uint32_t{0});
    third.put('z').put(std::uint8_t{1});
    const Contents got = read({writeOwn(
        m_folder, "unions.mcap",
        {message(first),
         message(second),
         message(third),
         {"/m", "a::M", "cdr", "omgidl",
          "module a { @mutable union M switch (long) { case 1: long x; }; };", third.bytes()}})});
    QVERIFY2(hasNote(got, "The union \"a::M\" is mutable"), joined(got.notes).c_str());
    QCOMPARE(got.notes.size(), std::size_t{1});
    QCOMPARE(got.messages.size(), std::size_t{3});
    QCOMPARE(got.messages[0].values,
             (std::map<std::string, std::string>{{"seen.discriminator", shown(1)},
                                                 {"seen.distance", shown(2.5)},
                                                 {"size.discriminator", shown(12)},
                                                 {"size.list[0]", shown(3)},
                                                 {"size.list[1]", shown(4)},
                                                 {"mark.discriminator", shown('y')},
                                                 {"mark.y", shown(0.5)},
                                                 {"end", shown(1)}}));
    QCOMPARE(got.messages[1].values,
             (std::map<std::string, std::string>{{"seen.discriminator", shown(7)},
                                                 {"seen.posts", shown(-4)},
                                                 {"size.discriminator", shown(5)},
                                                 {"size.word", "big"},
                                                 {"mark.discriminator", shown('x')},
                                                 {"mark.x", shown(9)},
                                                 {"end", shown(0)}}));
    QCOMPARE(got.messages[2].values,
             (std::map<std::string, std::string>{{"seen.discriminator", shown(3)},
                                                 {"size.discriminator", shown(-2)},
                                                 {"mark.discriminator", shown('z')},
                                                 {"end", shown(1)}}));
    QCOMPARE(got.fields.at("/b seen.discriminator").labels.at(7), std::string("GOAL"));
  }

  /// Arrays of arrays of empty things have no bytes, and must not take time.
  void nothingManyTimes() {
    const std::string nested =
        "module a { module msg {\n struct Empty {};\n struct C { Empty e[200000000]; };\n"
        " struct D { C c[200000000]; };\n struct B { D d[200000000]; };\n}; };\n";
    const Contents got = read({writeOwn(
        m_folder, "nothing.mcap",
        {{"/b", "a/msg/B", "cdr", "ros2idl", nested, std::string("\0\1\0\0\0\0\0\0", 8)}})});
    QCOMPARE(got.messages.size(), std::size_t{0});
    QVERIFY2(hasNote(got, "does not match"), joined(got.notes).c_str());
  }

  /// Every message of the files, cut and changed at every byte.
  void damagedMessages_data() { officialWriters_data(); }
  void damagedMessages() {
    QFETCH(QString, name);
    std::ifstream in(dataPath(name.toStdString() + ".mcap"), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const std::string path = m_folder.filePath("damaged.mcap").toStdString();
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
      std::ofstream(path, std::ios::binary) << changed;
      const Contents got = read({path});
      QVERIFY(got.messages.size() < 200);
    }
  }

  void csv_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QStringList>("wanted");  // of the first row
    QTest::newRow("plain") << "time,x,name\n0.5,1,a\n0.75,2,b\n"
                           << QStringList{"500000000", "x=1.0", "name=a"};
    QTest::newRow("semicolons and commas")
        << "\xEF\xBB\xBFZeit;t;Spannung [V]\r\nMo;1,5;12,25\r\nDi;2,5;12,5\r\n"
        << QStringList{"1500000000", "Zeit=Mo", "Spannung=12.25"};
    QTest::newRow("tabs, comments, quotes")
        << "# made by us\nt_ms\tvalue\tword\n1500\t3\t\"a\"\"b\tc\"\n1600\t4\td\n"
        << QStringList{"1500000000", "value=3.0", "word=a\"b\tc"};
    QTest::newRow("no header") << "0.0 5 6\n0.1 7 8\n0.2 9 10\n"
                               << QStringList{"0", "column2=5.0", "column3=6.0"};
    QTest::newRow("dates") << "when,x\n2026-07-01T10:00:00.25+02:00,1\n2026-07-01 08:00:01Z,2\n"
                           << QStringList{"1782892800250000000", "x=1.0"};
    QTest::newRow("unix ns") << "timestamp,id,on\n1782892800250000001,1234567890123456789,true\n"
                                "1782892800250000002,1234567890123456790,false\n"
                             << QStringList{"1782892800250000001", "id=1234567890123456789",
                                            "on=1.0"};
    QTest::newRow("no time") << "x,y\n5,1\n4,2\n3,\n" << QStringList{"0", "x=5.0", "y=1.0"};
    QTest::newRow("same names") << "t,x,x\n1,2,3\n2,4,5\n"
                                << QStringList{"1000000000", "x=2.0", "x (2)=3.0"};
  }
  void csv() {
    QFETCH(QString, text);
    QFETCH(QStringList, wanted);
    const Contents got = read({write("table.csv", text.toStdString())});
    QVERIFY2(!got.messages.empty(), joined(got.notes).c_str());
    QStringList found{QString::number(got.messages.front().time)};
    for (const auto& [path, value] : got.messages.front().values) {
      found << QString::fromStdString(path + "=" + value);
    }
    std::sort(found.begin() + 1, found.end());
    std::sort(wanted.begin() + 1, wanted.end());
    QCOMPARE(found, wanted);
  }

  void csvCountsWhatIsWrong() {
    const Contents got = read({write("wrong.csv", "time,x\n0,1\n1,2\n2,3\n")});
    QVERIFY2(got.notes.empty(), joined(got.notes).c_str());
    std::string text = "time,x\n";
    for (int i = 0; i < 600; ++i) text += std::to_string(i) + ",1\n";
    text += "soon,1\n600,many\n601\n";
    const Contents odd = read({write("odd.csv", text)});
    QCOMPARE(odd.messages.size(), std::size_t{602});
    QVERIFY(hasNote(odd, "1 row has no valid time"));
    QVERIFY(hasNote(odd, "1 cell is not a number"));
    QVERIFY(hasNote(odd, "1 row has another number of cells"));
  }

  void refereeLog() {
    RobotReply reply;
    reply.version = 4;
    reply.team = 12;
    reply.player = 3;
    reply.fallen = 0;
    reply.pose = {1500.0F, -500.0F, 0.5F};
    reply.ballAge = 0.5F;
    reply.ball = {600.0F, -100.0F};
    const std::string status = toBase64(*encodeReply(reply));
    const std::string path = write("match.yaml", R"(- timestamp:
    secs: 0
    nanos: 0
  entry: !metadata
    creator: GameController
    version: 6
    timestamp: 2026-07-01T10:00:00.5Z
    params:
      competition:
        name: Small
        division: small
        playersPerTeam: 4
        halfDuration:
          secs: 600
          nanos: 0
      game:
        teams:
          home:
            number: 12
            fieldPlayerColor: white
            goalkeeperColor: black
          away:
            number: 7
            fieldPlayerColor: red
            goalkeeperColor: black
- timestamp:
    secs: 1
    nanos: 0
  entry: !gameState
    sides: homeDefendsRightGoal
    stopped: false
    phase: firstHalf
    state: playing
    setPlay: noSetPlay
    kickingSide: null
    primaryTimer: !started
      remaining:
      - 580
      - 500000000
      runCondition: mainTimer
      behaviorAtZero: overflow
    secondaryTimer: stopped
    teams:
      home:
        goalkeeper: 1
        score: 2
        messageBudget: 100
        penaltyShot: 0
        penaltyShotMask: 0
        players:
        - penalty: noPenalty
          penaltyTimer: stopped
        - penalty: pushing
          penaltyTimer: !started
            remaining: "30.250000000"
            runCondition: playing
            behaviorAtZero: clip
      away:
        goalkeeper: 1
        score: 0
        messageBudget: 100
        penaltyShot: 0
        penaltyShotMask: 0
        players: []
- timestamp: {secs: 3, nanos: 500000000}
  entry: !statusMessage
    host: 10.0.12.3
    data: )" + status + R"(
- timestamp: {secs: 3, nanos: 600000000}
  entry: !teamMessage
    team: 12
    host: 10.0.12.3
    data: aGVsbG8=
- timestamp: {secs: 4, nanos: 0}
  entry: !action
    source: user
    action:
      type: goal
      args: {side: home}
- timestamp: {secs: 5, nanos: 0}
  entry: !newThing
    a: 1
- timestamp: {secs: 6, nanos: 0}
  entry: [broken
- timestamp: {secs: 7, nanos: 0}
  entry: !statusMessage
    host: 10.)");
    const auto readers = openRecordings({path});
    QVERIFY2(readers, readers ? "" : readers.error().text().c_str());
    RecordingReader& log = *readers->front();
    const std::int64_t start = 1'782'900'000'500'000'000;
    std::vector<std::pair<std::int64_t, Game>> games;
    std::vector<std::string> others;
    for (auto item = log.next(); item && *item != RecordedItem::End; item = log.next()) {
      if (*item == RecordedItem::Message) {
        others.push_back(std::string(log.message().texts[1]));
        continue;
      }
      const RecordedDatagram& datagram = log.datagram();
      const auto packet = decodeReferee(datagram.payload);
      if (datagram.localPort == 3838) {
        QVERIFY(packet);
        games.emplace_back(datagram.time - start, gameOf(std::get<RefereeState>(*packet)));
      } else {
        others.push_back(datagram.sender.address.text() + ":" + std::to_string(datagram.localPort));
      }
      if (datagram.localPort == 3939) {
        QCOMPARE((*std::get<RobotReply>(*packet).pose)[0], 1500.0F);
        QCOMPARE(datagram.time - start, std::int64_t{3'500'000'000});
      }
    }
    QCOMPARE(others.size(), std::size_t{3});
    QCOMPARE(others[0], std::string("10.0.12.3:3939"));
    QCOMPARE(others[1], std::string("10.0.12.3:10012"));
    QCOMPARE(others[2], std::string("goal {side: home}"));
    QVERIFY2(games.size() >= 5, std::to_string(games.size()).c_str());
    const Game& first = games.front().second;
    QCOMPARE(games.front().first, std::int64_t{1'000'000'000});
    QVERIFY(first.state == PlayState::Playing && first.league == League::HumanoidSoccer);
    QCOMPARE(first.secondsLeft(), 581);
    QCOMPARE(first.teams[0].number, 7);  // the first team defends the left goal
    QCOMPARE(first.teams[1].score, 2);
    QVERIFY(first.teams[1].colour == TeamColor::White);
    QVERIFY(first.teams[1].player(2)->penalty == PenaltyKind::Pushing);
    QCOMPARE(first.penaltySeconds(*first.teams[1].player(2)), 31);
    // The clocks run on between the entries.
    const auto later = std::find_if(games.begin(), games.end(), [](const auto& game) {
      return game.first == std::int64_t{3'000'000'000};
    });
    QVERIFY(later != games.end());
    QCOMPARE(later->second.secondsLeft(), 579);
    QCOMPARE(later->second.penaltySeconds(*later->second.teams[1].player(2)), 29);
    const std::string notes = joined(log.notes());
    QVERIFY2(notes.find("1 entry of the unknown kind \"!newThing\"") != notes.npos, notes.c_str());
    QVERIFY2(notes.find("1 entry is not valid") != notes.npos, notes.c_str());
    QVERIFY2(notes.find("cut off") != notes.npos, notes.c_str());
  }

  void whatIsNoRecording() {
    const auto none = openRecordings({dataPath("nosuch.mcap")});
    QVERIFY(!none && none.error().code == ErrorCode::NotFound);
    const auto unknown = openRecordings({write("picture.png", "\x89PNG\r\n")});
    QVERIFY(!unknown && unknown.error().code == ErrorCode::Unsupported);
    QVERIFY(unknown.error().message.find(
                "MCAP, rosbag2 (sqlite3), GameController log (YAML), CSV") != std::string::npos);
    const auto ours =
        openRecordings({std::string(PITCHBOARD_SOURCE_DIR) + "/tests/data/sessions/small.mcap"});
    QVERIFY(!ours && ours.error().code == ErrorCode::InvalidArgument);
    const auto folder = openRecordings({m_folder.path().toStdString() + "/."});
    QVERIFY(folder || folder.error().code != ErrorCode::SystemError);
    const auto database = openRecordings(
        {write("odd.db3", std::string("SQLite format 3\0", 16) + std::string(600, 'x'))});
    QVERIFY(!database && database.error().code == ErrorCode::ParseError);
  }
};

PITCHBOARD_TEST(TestRecordings)

}  // namespace tst_recordings

#include "tst_recordings.moc"
