// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/option_form.h>

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QSettings>
#include <QSpinBox>
#include <algorithm>
#include <cmath>

#include <ui/base/number_box.h>

namespace pitchboard::ui {
namespace {

using Texts = std::vector<std::string>;

Texts textsFrom(const QStringList& list) {
  Texts texts;
  for (const QString& text : list) texts.push_back(text.toStdString());
  return texts;
}

OptionField choiceField(const OptionInfo& option, QWidget* parent) {
  auto* box = new QComboBox(parent);
  const auto known = std::make_shared<std::vector<OptionChoice>>(option.choices());
  for (const OptionChoice& choice : *known) box->addItem(QString::fromStdString(choice.label));
  return {box,
          [box, known] { return known->at(static_cast<std::size_t>(box->currentIndex())).value; },
          [box, known](const OptionValue& value) {
            auto found = std::ranges::find(*known, value, &OptionChoice::value);
            const auto index = static_cast<int>(found - known->begin());
            if (found == known->end()) {
              known->push_back({value, optionText(value)});
              box->addItem(QString::fromStdString(known->back().label));
            }
            box->setCurrentIndex(index);
          }};
}

struct FieldMaker {
  const OptionInfo& option;
  QWidget* parent;

  OptionField operator()(bool) const {
    auto* box = new QCheckBox(QString::fromUtf8(option.title), parent);
    return {box, [box]() -> OptionValue { return box->isChecked(); },
            [box](const OptionValue& value) { box->setChecked(std::get<bool>(value)); }};
  }
  OptionField operator()(int) const {
    auto* box = new QSpinBox(parent);
    box->setRange(static_cast<int>(option.min), static_cast<int>(option.max));
    box->setSpecialValueText(QString::fromUtf8(option.unset));
    if (*option.unit) box->setSuffix(QStringLiteral(" %1").arg(QString::fromUtf8(option.unit)));
    return {box, [box]() -> OptionValue { return box->value(); },
            [box](const OptionValue& value) { box->setValue(std::get<int>(value)); }};
  }
  OptionField operator()(double) const {
    auto* box = new NumberBox(parent);
    box->setDecimals(option.decimals);
    box->setRange(option.min, option.max);
    box->setSingleStep(option.decimals > 1 ? 0.05 : 1.0);
    if (*option.unit) box->setSuffix(QStringLiteral(" %1").arg(QString::fromUtf8(option.unit)));
    return {box, [box]() -> OptionValue { return box->value(); },
            [box](const OptionValue& value) { box->setValue(std::get<double>(value)); }};
  }
  OptionField operator()(const std::string&) const {
    QLineEdit* edit = makeEdit();
    return {edit, [edit]() -> OptionValue { return edit->text().trimmed().toStdString(); },
            [edit](const OptionValue& value) {
              edit->setText(QString::fromStdString(optionText(value)));
            }};
  }
  OptionField operator()(const Texts&) const {
    QLineEdit* edit = makeEdit();
    return {edit, [edit]() -> OptionValue { return textsOf(edit->text().toStdString()); },
            [edit](const OptionValue& value) {
              edit->setText(QString::fromStdString(optionText(value)));
            }};
  }
  OptionField operator()(std::uint64_t) const {
    QLineEdit* edit = makeEdit();
    return {edit,
            [edit]() -> OptionValue { return std::uint64_t{edit->text().trimmed().toULongLong()}; },
            [edit](const OptionValue& value) {
              edit->setText(QString::fromStdString(optionText(value)));
            }};
  }
  QLineEdit* makeEdit() const {
    auto* edit = new QLineEdit(parent);
    edit->setPlaceholderText(QString::fromUtf8(option.unset));
    return edit;
  }
};

}  // namespace

OptionField makeOptionField(const OptionInfo& option, const OptionValue& usual, QWidget* parent) {
  return option.choices ? choiceField(option, parent)
                        : std::visit(FieldMaker{option, parent}, usual);
}

void addOptionRow(QFormLayout* form, const OptionInfo& option, const OptionField& field) {
  field.widget->setObjectName(QString::fromUtf8(option.key));
  field.widget->setToolTip(QString::fromUtf8(option.text));
  if (qobject_cast<QCheckBox*>(field.widget) != nullptr)
    form->addRow(field.widget);
  else
    form->addRow(QString::fromUtf8(option.title), field.widget);
}

void putSetting(QSettings& settings, const QString& key, const OptionValue& value) {
  struct Converter {
    QVariant operator()(bool on) const { return on; }
    QVariant operator()(int number) const { return number; }
    QVariant operator()(std::uint64_t number) const { return static_cast<qulonglong>(number); }
    QVariant operator()(double number) const { return number; }
    QVariant operator()(const std::string& text) const { return QString::fromStdString(text); }
    QVariant operator()(const Texts& texts) const {
      QStringList list;
      for (const std::string& text : texts) list << QString::fromStdString(text);
      return list;
    }
  };
  settings.setValue(key, std::visit(Converter{}, value));
}

Result<std::optional<OptionValue>> settingOf(const QSettings& settings, const QString& key,
                                             const OptionValue& like) {
  if (!settings.contains(key)) return std::optional<OptionValue>();
  const QVariant saved = settings.value(key);
  struct Converter {
    const QVariant& saved;
    bool& good;
    OptionValue operator()(bool) const { return saved.toBool(); }
    OptionValue operator()(int) const { return saved.toInt(&good); }
    OptionValue operator()(std::uint64_t) const { return std::uint64_t{saved.toULongLong(&good)}; }
    OptionValue operator()(double) const {
      const double number = saved.toDouble(&good);
      good = good && std::isfinite(number);
      return number;
    }
    OptionValue operator()(const std::string&) const { return saved.toString().toStdString(); }
    OptionValue operator()(const Texts&) const { return textsFrom(saved.toStringList()); }
  };
  bool good = true;
  OptionValue value = std::visit(Converter{saved, good}, like);
  if (good) return std::optional(std::move(value));
  return failure(ErrorCode::ParseError, "This setting is no number.", key.toStdString());
}

}  // namespace pitchboard::ui
