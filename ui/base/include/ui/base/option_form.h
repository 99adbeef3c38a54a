// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options of a table (<base/options.h>) in the user's settings, and as rows of a form. UI thread
// only; settings on any thread, one at a time.

#include <QString>
#include <QWidget>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <base/options.h>

class QFormLayout;
class QSettings;

namespace pitchboard::ui {

/// A widget for one option. Its object name is the option's key.
struct OptionField {
  QWidget* widget = nullptr;
  std::function<OptionValue()> read;
  std::function<void(const OptionValue&)> show;
};
/// `usual` is the option's default.
OptionField makeOptionField(const OptionInfo& option, const OptionValue& usual, QWidget* parent);
/// Adds a row with the option's title; its text is the tool tip.
void addOptionRow(QFormLayout* form, const OptionInfo& option, const OptionField& field);

void putSetting(QSettings& settings, const QString& key, const OptionValue& value);
/// Returns nothing if there is none; an error if it is of another type.
Result<std::optional<OptionValue>> settingOf(const QSettings& settings, const QString& key,
                                             const OptionValue& like);

/// Saves all options that have a key.
template <class Values>
void saveOptions(QSettings& settings, const QString& prefix,
                 std::type_identity_t<std::span<const Option<Values>>> table,
                 const Values& values) {
  for (const Option<Values>& option : table) {
    if (option.info.key == nullptr) continue;
    putSetting(settings, prefix + QString::fromUtf8(option.info.key), option.access.get(values));
  }
}

/// Loads them. What cannot be read keeps its value; of several texts, those that can be read are
/// taken. Returns the last error.
template <class Values>
Result<void> loadOptions(const QSettings& settings, const QString& prefix,
                         std::type_identity_t<std::span<const Option<Values>>> table,
                         Values& values) {
  Result<void> all;
  for (const Option<Values>& option : table) {
    if (option.info.key == nullptr) continue;
    const auto saved =
        settingOf(settings, prefix + QString::fromUtf8(option.info.key), option.access.get(values));
    Result<void> done;
    if (!saved)
      done = tl::unexpected(saved.error());
    else if (*saved)
      done = setOption(values, option, **saved);
    if (done) continue;
    all = done;
    if (!saved || !*saved) continue;
    const auto* texts = std::get_if<std::vector<std::string>>(&**saved);
    if (texts == nullptr) continue;
    std::vector<std::string> good;
    for (const std::string& text : *texts) {
      good.push_back(text);
      if (!setOption(values, option, good)) good.pop_back();
    }
  }
  return all;
}

/// The rows of a dialog.
template <class Values>
class OptionForm {
 public:
  /// Adds the option, with a field of its own if there is none yet.
  void add(QFormLayout* form, const Option<Values>& option, QWidget* parent,
           OptionField field = {}) {
    if (field.widget == nullptr) {
      field = makeOptionField(option.info, option.access.get(Values{}), parent);
    }
    addOptionRow(form, option.info, field);
    m_rows.emplace_back(&option, std::move(field));
  }
  void show(const Values& values) const {
    for (const auto& [option, field] : m_rows) field.show(option->access.get(values));
  }
  /// The context of an error is the option's title.
  Result<void> read(Values& values) const {
    for (const auto& [option, field] : m_rows) {
      const auto set = setOption(values, *option, field.read());
      if (!set) {
        return failure(set.error().code, set.error().text(), option->info.title);
      }
    }
    return {};
  }

 private:
  std::vector<std::pair<const Option<Values>*, OptionField>> m_rows;
};

}  // namespace pitchboard::ui
