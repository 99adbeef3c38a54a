// SPDX-License-Identifier: GPL-3.0-or-later
// Tables as text: RFC 4180 and what spreadsheets and programs make of it. Separator, decimal sign,
// names, times and kinds of columns are guessed from the first rows.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

#include <base/try.h>
#include <base/units.h>
#include <telemetry/recordings/decoded_topics.h>

#include "message_shape.h"
#include "recording_formats.h"
#include "text_file.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxCsvColumns = 4096, csvSampleRows = 500;
constexpr std::size_t maxNumberDigits = 15;  // longer ones are identifiers

using Cells = std::vector<std::string>;

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// How the numbers and cells of a file are written.
struct CsvForm {
  char separator = ',';
  bool hasDecimalComma = false;
};

/// Splits a line; returns false inside quotes, which go on in the next line.
bool splitCells(std::string_view line, char separator, Cells& cells, bool isContinued) {
  bool isQuoted = isContinued;
  if (!isContinued) cells.assign(1, {});
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    std::string& cell = cells.back();
    if (isQuoted) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        cell += c;
        ++i;
      } else {
        isQuoted = false;
      }
    } else if (c == '"' && withoutBlanks(cell).empty()) {
      cell.clear();
      isQuoted = true;
    } else if (c == separator) {
      // Blanks between columns count once.
      if (separator == ' ' && cell.empty()) continue;
      if (cells.size() < maxCsvColumns) cells.emplace_back();
    } else {
      cell += c;
    }
  }
  if (separator == ' ' && cells.size() > 1 && cells.back().empty() && !isQuoted) cells.pop_back();
  return !isQuoted;
}

/// Reads the rows of a file; comments and empty lines are left out.
class CsvRows {
 public:
  explicit CsvRows(TextFile file) : m_file(std::move(file)) {}

  bool next(char separator, Cells& cells) {
    bool isContinued = false;
    std::size_t bytes = 0;
    while (auto line = m_file.line()) {
      ++m_line;
      if (m_line == 1 && line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
      const std::string_view text = withoutBlanks(*line);
      if (!isContinued && (text.empty() || text.starts_with('#'))) continue;
      if (isContinued) cells.back() += '\n';
      if (splitCells(*line, separator, cells, isContinued)) return true;
      bytes += line->size();
      if (bytes > TextFile::maxLine) return true;  // a quote that nobody closed
      isContinued = true;
    }
    return isContinued;
  }
  void rewind() {
    m_file.rewind();
    m_line = 0;
  }
  double progress() const { return m_file.progress(); }

 private:
  TextFile m_file;
  std::size_t m_line = 0;
};

std::optional<double> csvNumber(std::string_view text, bool hasDecimalComma) {
  text = withoutBlanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  std::string own;
  if (hasDecimalComma && text.find(',') != text.npos) {
    own = text;
    std::ranges::replace(own, ',', '.');
    text = own;
  }
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size()) return {};
  if (code == std::errc::result_out_of_range) return {};
  if (code != std::errc()) return {};
  return value;
}

bool isIdentifier(std::string_view text) {
  text = withoutBlanks(text);
  return text.size() > maxNumberDigits && text.find_first_not_of("0123456789") == text.npos;
}

std::optional<bool> csvFlag(std::string_view text) {
  std::string lower(withoutBlanks(text).substr(0, 6));
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (lower == "true") return true;
  if (lower == "false") return false;
  return {};
}

bool isMissing(std::string_view text) {
  static constexpr std::array<std::string_view, 6> words{"", "nan", "NaN", "NA", "null", "-"};
  return std::ranges::find(words, withoutBlanks(text)) != words.end();
}

/// The unit of a time: factor to ns, by its name or its size.
struct TimeUnit {
  double toNs = 1e9;
  bool isDate = false;
};

TimeUnit unitBySize(double value) {
  const double size = std::abs(value);
  if (size > 1e17) return {1.0};
  if (size > 1e14) return {1e3};
  if (size > 1e11) return {1e6};
  return {1e9};
}

struct CsvColumn {
  RecordedField field;
  bool isUsed = true;
};

/// "voltage [V]" and "voltage (V)" name the unit.
RecordedField csvField(std::string_view name, std::size_t index) {
  name = withoutBlanks(name);
  RecordedField field;
  field.path = cutText(name, 200);
  const auto open = name.find_last_of("[(");
  if (open != name.npos && open > 0 && (name.ends_with(']') || name.ends_with(')')) &&
      name.size() - open <= 14 && name.size() - open > 2) {
    const std::string_view unit = name.substr(open + 1, name.size() - open - 2);
    // "position[3]" and "position[knee]" are names of elements.
    const bool isUnit = name[open] == '(' || unitNamed(unit) != nullptr || name[open - 1] == ' ';
    if (isUnit && unit.find_first_not_of("0123456789") != unit.npos) {
      field.path = withoutBlanks(name.substr(0, open));
      field.unit = unit;
    }
  }
  if (field.path.empty()) field.path = "column" + std::to_string(index + 1);
  return field;
}

class CsvRecording : public RecordingReader {
 public:
  static OpenedRecording open(const std::string& path) {
    auto file = TRY(TextFile::open(path));
    auto table = std::unique_ptr<CsvRecording>(new CsvRecording(path, CsvRows(std::move(file))));
    TRY(table->guess());
    return table;
  }

  const std::vector<RecordedTopic>& topics() const override { return m_topics; }
  double progress() const override { return m_rows.progress(); }

  Result<RecordedItem> next() override {
    while (m_rows.next(m_form.separator, m_cells)) {
      ++m_row;
      if (takeRow()) return RecordedItem::Message;
    }
    return RecordedItem::End;
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    if (!m_timeColumn) {
      notes.push_back(m_path + ": no column with times was found, so the row number is the time.");
    }
    if (m_wrongTimes > 0) {
      notes.push_back(m_path + ": " + countText(m_wrongTimes, "row has", "rows have") +
                      " no valid time and " + (m_wrongTimes == 1 ? "was" : "were") + " left out.");
    }
    if (m_wrongCells > 0) {
      notes.push_back(m_path + ": " + countText(m_wrongCells, "cell is", "cells are") +
                      " not a number in a column of numbers.");
    }
    if (m_shortRows > 0) {
      notes.push_back(m_path + ": " + countText(m_shortRows, "row has", "rows have") +
                      " another number of cells than the first.");
    }
    return notes;
  }

 private:
  CsvRecording(std::string path, CsvRows rows) : m_path(std::move(path)), m_rows(std::move(rows)) {}

  Result<void> guess() {
    guessSeparator();
    std::vector<Cells> sample;
    Cells cells;
    while (sample.size() < csvSampleRows && m_rows.next(m_form.separator, cells)) {
      sample.push_back(cells);
    }
    m_rows.rewind();
    if (sample.empty()) {
      return failure(ErrorCode::ParseError, "The table is empty.", m_path);
    }
    guessDecimal(sample);
    const Cells first = sample.front();
    m_hasHeader = std::ranges::none_of(first, [this](const std::string& cell) {
      return csvNumber(cell, m_form.hasDecimalComma) || isoTime(cell);
    });
    if (m_hasHeader) sample.erase(sample.begin());
    for (std::size_t i = 0; i < first.size(); ++i) {
      m_columns.push_back({csvField(m_hasHeader ? first[i] : std::string(), i)});
    }
    guessTime(sample);
    guessKinds(sample);
    nameTopic();
    if (m_hasHeader) (void)m_rows.next(m_form.separator, cells);
    return {};
  }

  /// The one that splits most rows into the same number of cells.
  void guessSeparator() {
    std::size_t best = 0;
    for (const char separator : {',', ';', '\t', ' '}) {
      std::map<std::size_t, std::size_t> counts;
      Cells cells;
      for (std::size_t row = 0; row < 50 && m_rows.next(separator, cells); ++row) {
        if (cells.size() > 1) ++counts[cells.size()];
      }
      m_rows.rewind();
      for (const auto& [size, rows] : counts) {
        // A semicolon is never part of a number.
        const std::size_t score = rows * 100 + (separator == ';' ? 50 : 0);
        if (score > best) {
          best = score;
          m_form.separator = separator;
        }
      }
    }
  }

  void guessDecimal(const std::vector<Cells>& sample) {
    if (m_form.separator == ',') return;
    std::size_t commas = 0, points = 0;
    for (const Cells& cells : sample) {
      for (const std::string& cell : cells) {
        if (cell.find(',') != cell.npos && csvNumber(cell, true)) ++commas;
        if (cell.find('.') != cell.npos && csvNumber(cell, false)) ++points;
      }
    }
    m_form.hasDecimalComma = commas > points;
  }

  static std::string_view cellAt(const Cells& cells, std::size_t index) {
    return index < cells.size() ? std::string_view(cells[index]) : std::string_view();
  }

  void guessTime(const std::vector<Cells>& sample) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < m_columns.size() && !best; ++i) {
      if (isTimeName(m_columns[i].field.path) && hasTimes(sample, i)) best = i;
    }
    for (std::size_t i = 0; i < m_columns.size() && !best; ++i) {
      if (!sample.empty() && isoTime(withoutBlanks(cellAt(sample.front(), i)))) best = i;
    }
    // A first column that never goes back.
    if (!best && sample.size() > 2 && !m_columns.empty() && hasTimes(sample, 0) &&
        isIncreasing(sample)) {
      best = 0;
    }
    if (!best) return;
    m_timeColumn = best;
    CsvColumn& column = m_columns[*best];
    column.isUsed = false;
    const std::string_view example = cellAt(sample.front(), *best);
    m_timeUnit.isDate = isoTime(withoutBlanks(example)).has_value();
    if (m_timeUnit.isDate) return;
    const Unit* unit = unitNamed(column.field.unit.empty() ? unitInName(column.field.path)
                                                           : std::string_view(column.field.unit));
    m_timeUnit = unit != nullptr && unit->kind == UnitKind::Time
                     ? TimeUnit{unit->factor * 1e9}
                     : unitBySize(csvNumber(example, m_form.hasDecimalComma).value_or(0.0));
  }

  static std::string lowerCase(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return out;
  }

  static bool isTimeName(std::string_view name) {
    static constexpr std::array<std::string_view, 14> names{
        "time", "t",        "timestamp", "stamp",  "sec",       "secs", "seconds",
        "date", "datetime", "clock",     "__time", "unix_time", "ms",   "log_time"};
    const std::string lower = lowerCase(name);
    if (std::ranges::find(names, lower) != names.end()) return true;
    return lower.starts_with("t_") || lower.starts_with("time_") ||
           lower.starts_with("timestamp_") || lower.ends_with("_time") ||
           lower.ends_with("timestamp");
  }

  static std::string_view unitInName(std::string_view name) {
    for (const std::string_view unit : {"ns", "us", "ms", "s"}) {
      if (name == unit || name.ends_with("_" + std::string(unit))) return unit;
    }
    return {};
  }

  bool hasTimes(const std::vector<Cells>& sample, std::size_t column) const {
    return !sample.empty() && std::ranges::all_of(sample, [&](const Cells& cells) {
      const std::string_view cell = withoutBlanks(cellAt(cells, column));
      return csvNumber(cell, m_form.hasDecimalComma) || isoTime(cell);
    });
  }

  bool isIncreasing(const std::vector<Cells>& sample) const {
    double before = -std::numeric_limits<double>::infinity();
    for (const Cells& cells : sample) {
      const auto value = csvNumber(cellAt(cells, 0), m_form.hasDecimalComma);
      if (!value || *value <= before) return false;
      before = *value;
    }
    return true;
  }

  void guessKinds(const std::vector<Cells>& sample) {
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      bool isNumber = true, isFlag = true, isAny = false;
      for (const Cells& cells : sample) {
        const std::string_view cell = cellAt(cells, i);
        if (isMissing(cell)) continue;
        isAny = true;
        isFlag = isFlag && csvFlag(cell);
        isNumber = isNumber && csvNumber(cell, m_form.hasDecimalComma) && !isIdentifier(cell);
      }
      RecordedKind& kind = m_columns[i].field.kind;
      if (isAny && !isNumber) kind = isFlag ? RecordedKind::Flag : RecordedKind::Text;
    }
  }

  void nameTopic() {
    auto shape = std::make_shared<RecordedShape>();
    for (const CsvColumn& column : m_columns) {
      if (column.isUsed) shape->fields.push_back(column.field);
    }
    // Names that occur twice get a number.
    std::map<std::string, int> seen;
    for (RecordedField& field : shape->fields) {
      const int n = ++seen[field.path];
      if (n > 1) field.path += " (" + std::to_string(n) + ")";
    }
    m_shape = std::move(shape);
    const std::string stem = std::filesystem::path(m_path).stem().string();
    m_topics.push_back({stem.empty() ? "table" : stem, "", "csv"});
  }

  std::optional<std::int64_t> timeOf() const {
    if (!m_timeColumn) return static_cast<std::int64_t>(m_row - 1) * 1'000'000'000;
    const std::string_view cell = withoutBlanks(cellAt(m_cells, *m_timeColumn));
    if (m_timeUnit.isDate) return isoTime(cell);
    if (m_timeUnit.toNs == 1.0) {  // a double does not hold all of its digits
      std::int64_t value = 0;
      const auto [end, code] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (code == std::errc() && end == cell.data() + cell.size()) return value;
    }
    const auto value = csvNumber(cell, m_form.hasDecimalComma);
    constexpr double most = 9e18;
    if (!value || !(std::abs(*value * m_timeUnit.toNs) < most)) return {};
    // Seconds and the rest by themselves keep nanoseconds.
    const double whole = std::floor(*value);
    return static_cast<std::int64_t>(whole) * static_cast<std::int64_t>(m_timeUnit.toNs) +
           std::llround((*value - whole) * m_timeUnit.toNs);
  }

  bool takeRow() {
    if (m_cells.size() != m_columns.size()) ++m_shortRows;
    const auto time = timeOf();
    if (!time) {
      ++m_wrongTimes;
      return false;
    }
    m_values.clear();
    m_texts.clear();
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      if (m_columns[i].isUsed) takeCell(m_columns[i].field.kind, cellAt(m_cells, i));
    }
    m_message = {0, *time, {}, m_shape, m_values, m_texts};
    return true;
  }

  void takeCell(RecordedKind kind, std::string_view cell) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (kind == RecordedKind::Text) {
      m_texts.push_back(cutText(withoutBlanks(cell)));
    } else if (!isMissing(cell)) {
      const auto flag = csvFlag(cell);
      const auto number =
          flag ? std::optional<double>(*flag ? 1.0 : 0.0) : csvNumber(cell, m_form.hasDecimalComma);
      if (number)
        value = *number;
      else
        ++m_wrongCells;
    }
    m_values.push_back(value);
  }

  std::string m_path;
  CsvRows m_rows;
  CsvForm m_form;
  bool m_hasHeader = false;
  std::vector<CsvColumn> m_columns;
  std::optional<std::size_t> m_timeColumn;
  TimeUnit m_timeUnit;
  std::vector<RecordedTopic> m_topics;
  std::shared_ptr<const RecordedShape> m_shape;
  Cells m_cells;
  std::uint64_t m_row = 0, m_wrongTimes = 0, m_wrongCells = 0, m_shortRows = 0;
  std::vector<double> m_values;
  std::vector<std::string_view> m_texts;
};

/// Several tables, merged by time.
class CsvRecordings : public RecordingReader {
 public:
  Result<void> add(const std::string& path) {
    auto table = TRY(CsvRecording::open(path));
    m_topics.insert(m_topics.end(), table->topics().begin(), table->topics().end());
    m_tables.push_back({std::move(table), false, false});
    return {};
  }
  const std::vector<RecordedTopic>& topics() const override { return m_topics; }
  double progress() const override {
    double sum = 0.0;
    for (const Table& table : m_tables) sum += table.reader->progress();
    return sum / static_cast<double>(m_tables.size());
  }
  Result<RecordedItem> next() override {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < m_tables.size(); ++i) {
      Table& table = m_tables[i];
      if (!table.isRead) {
        table.isEnded = TRY(table.reader->next()) == RecordedItem::End;
        table.isRead = true;
      }
      if (table.isEnded) continue;
      if (!first || table.reader->message().logTime < m_tables[*first].reader->message().logTime) {
        first = i;
      }
    }
    if (!first) return RecordedItem::End;
    m_message = m_tables[*first].reader->message();
    m_message.topic = *first;
    m_tables[*first].isRead = false;
    return RecordedItem::Message;
  }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    for (const Table& table : m_tables) {
      for (std::string& note : table.reader->notes()) notes.push_back(std::move(note));
    }
    return notes;
  }

 private:
  struct Table {
    std::unique_ptr<RecordingReader> reader;
    bool isRead, isEnded;
  };
  std::vector<Table> m_tables;
  std::vector<RecordedTopic> m_topics;
};

}  // namespace

bool isCsvRecording(const std::string& path, std::string_view beginning) {
  const std::string ending = std::filesystem::path(path).extension().string();
  static constexpr std::array<std::string_view, 4> endings{".csv", ".tsv", ".txt", ".dat"};
  return std::ranges::find(endings, ending) != endings.end() && !beginning.empty() &&
         beginning.find('\0') == beginning.npos;
}

OpenedRecording openCsvRecording(const std::vector<std::string>& files, const RecordingProgress&) {
  auto tables = std::make_unique<CsvRecordings>();
  for (const std::string& file : files) TRY(tables->add(file));
  return tables;
}

}  // namespace pitchboard::telemetry
