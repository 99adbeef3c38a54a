// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/models/robot_models.h>
#include <ui/base/beat.h>
#include <ui/noise/noise_dock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <array>
#include <functional>

#include <simcore/world/parameters.h>
#include <ui/base/explanation.h>
#include <ui/base/number_box.h>
#include <ui/base/robot_text.h>
#include <ui/base/scrolled_form.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

/// A slider and a spin box for the same number.
class ParameterRow : public QObject {
 public:
  /// Adds a row to the grid. `edited` is called with the shown value after changes by the user
  /// only.
  ParameterRow(QGridLayout* grid, const QString& name, const QString& tip,
               const sim::ShownParameter& shown, std::function<void(double)> edited,
               QWidget* parent)
      : QObject(parent),
        m_slider(new QSlider(Qt::Horizontal, parent)),
        m_box(new NumberBox(parent)),
        m_edited(std::move(edited)) {
    auto* label = new QLabel(name, parent);
    label->setToolTip(tip);
    label->setBuddy(m_box);
    m_box->setDecimals(shown.decimals);
    m_box->setRange(shown.least, shown.most);
    m_box->setSuffix(QString::fromUtf8(shown.unit));
    m_box->setSingleStep((shown.most - shown.least) / 50);
    m_box->setAlignment(Qt::AlignRight);
    m_box->setKeyboardTracking(false);
    m_box->setButtonSymbols(QAbstractSpinBox::NoButtons);  // the slider is the quick way
    m_box->setToolTip(tip);
    m_box->setAccessibleName(name);
    m_box->setMinimumWidth(scaled(parent, 108));
    m_slider->setRange(0, steps);
    m_slider->setMinimumWidth(scaled(parent, 60));
    m_slider->setToolTip(tip);
    m_slider->setFocusPolicy(Qt::NoFocus);
    const int row = grid->rowCount();
    grid->addWidget(label, row, 0);
    grid->addWidget(m_slider, row, 1);
    grid->addWidget(m_box, row, 2);
    connect(m_slider, &QSlider::valueChanged, this, [this](int at) {
      const double range = m_box->maximum() - m_box->minimum();
      m_box->setValue(m_box->minimum() + range * at / steps);
    });
    connect(m_box, &NumberBox::valueChanged, this, [this](double value) {
      moveSlider();
      m_edited(value);
    });
  }

  void setEnabled(bool enabled) {
    m_slider->setEnabled(enabled);
    m_box->setEnabled(enabled);
  }

  /// Shows a value without calling `edited`. Does nothing while the user edits the row.
  void show(double value) {
    if (m_box->hasFocus() || m_slider->isSliderDown()) return;
    const QSignalBlocker quiet(m_box);
    m_box->setValue(value);
    moveSlider();
  }

 private:
  static constexpr int steps = 200;
  void moveSlider() {
    const QSignalBlocker quiet(m_slider);
    const double range = m_box->maximum() - m_box->minimum();
    m_slider->setValue(qRound((m_box->value() - m_box->minimum()) / range * steps));
  }

  QSlider* m_slider;
  NumberBox* m_box;
  std::function<void(double)> m_edited;
};

namespace {

using Noise = sim::NoiseParameters;
using Body = sim::RigidBodySettings;

QLabel* partTitle(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(themeFont(TypeRole::Body, true));
  label->setContentsMargins(0, scaled(parent, 8), 0, 0);
  return label;
}

class NoiseDock : public ScrolledForm {
 public:
  NoiseDock(MatchController* controller, RobotSelection* selection, const ShownMoment* shown,
            QWidget* parent)
      : ScrolledForm(parent, 0), m_controller(controller), m_selection(selection), m_moment(shown) {
    addNoise(form(), column());
    addRobots(form(), column());
    addPhysics(form(), column());
    finishForm();
    connect(m_controller, &MatchController::scenarioChanged, this, [this] { adopt(); });
    m_follow = Beat::display().add(this, {}, [this] { follow(); });
    connect(m_moment, &FrameSource::frameReceived, this, [this] { m_follow->want(); });
    connect(m_controller->edits(), &MatchEdits::robotsChanged, this, [this] { showRobots(); });
    connect(m_controller->edits(), &MatchEdits::physicsChanged, this,
            [this] { showPhysics(m_controller->edits()->physics()); });
    connect(m_controller->edits(), &MatchEdits::lockedChanged, this, [this](bool locked) {
      form()->setEnabled(!locked);
      follow();
    });
    connect(m_selection, &RobotSelection::changed, this, [this] { showRobots(); });
    adopt();
  }

 private:
  void addNoise(QWidget* form, QVBoxLayout* column) {
    column->addWidget(partTitle(QStringLiteral("Noise"), form));
    m_preset = new QComboBox(form);
    m_preset->setObjectName(QStringLiteral("noisePreset"));
    for (const std::string& name : link::noisePresets()) {
      m_preset->addItem(QString::fromStdString(name));
    }
    m_preset->addItem(QStringLiteral("custom"));
    connect(m_preset, &QComboBox::activated, this, [this] { choosePreset(); });
    column->addWidget(m_preset);
    auto* grid = new QGridLayout;
    grid->setVerticalSpacing(scaled(this, 4));
    grid->setColumnStretch(1, 1);
    for (const auto& p : sim::noiseParameters) {
      m_noiseRows.push_back(rowOf(grid, p, form, [this, &p](double stored) {
        m_noise.*p.member = stored;
        showPreset();
        m_controller->edits()->setNoise(m_noise);
      }));
    }
    column->addLayout(grid);
  }

  void addRobots(QWidget* form, QVBoxLayout* column) {
    m_whose = partTitle(QStringLiteral("Robots"), form);
    m_whose->setObjectName(QStringLiteral("whoseModel"));
    column->addWidget(m_whose);
    m_robots = new QWidget(form);
    auto* robots = new QVBoxLayout(m_robots);
    robots->setContentsMargins(0, 0, 0, 0);
    m_kind = new QComboBox(m_robots);
    m_kind->setObjectName(QStringLiteral("robotModel"));
    for (const std::string& name : link::robotModels()) {
      const link::RobotModelText text = link::robotModelText(name);
      m_kind->addItem(QString::fromStdString(text.title), QString::fromStdString(name));
      m_kind->setItemData(m_kind->count() - 1, QString::fromStdString(text.description),
                          Qt::ToolTipRole);
    }
    m_kind->addItem(QStringLiteral("custom"));
    connect(m_kind, &QComboBox::activated, this, [this] {
      const auto model = link::loadRobotModel(m_kind->currentData().toString().toStdString());
      if (model) m_controller->edits()->setModel(edited(), *model);
      showRobots();
    });
    robots->addWidget(m_kind);
    m_kick = new QComboBox(m_robots);
    m_kick->setObjectName(QStringLiteral("kickLaw"));
    m_kick->addItem(QStringLiteral("Kick: published force at a distance"));
    m_kick->addItem(QStringLiteral("Kick: foot with reach and angle"));
    connect(m_kick, &QComboBox::activated, this, [this](int law) {
      m_robot.kickLaw = static_cast<sim::KickLaw>(law);
      changeRobots();
    });
    robots->addWidget(m_kick);
    auto* grid = new QGridLayout;
    grid->setVerticalSpacing(scaled(this, 4));
    grid->setColumnStretch(1, 1);
    for (const auto& p : sim::robotModelParameters) {
      m_robotRows.push_back(rowOf(grid, p, m_robots, [this, &p](double stored) {
        m_robot.*p.member = stored;
        changeRobots();
      }));
    }
    robots->addLayout(grid);
    column->addWidget(m_robots);
  }

  /// The selected robots, or all.
  std::vector<RobotId> edited() const {
    std::vector<RobotId> ids;
    if (const FramePtr frame = m_controller->frame()) ids = frame->slotsOf(m_selection->ids());
    std::erase_if(ids, [this](RobotId id) { return m_controller->edits()->robot(id) == nullptr; });
    if (!ids.empty()) return ids;
    for (int id = 1; id <= sim::Simulation::maxRobots; ++id) {
      if (m_controller->edits()->robot(RobotId{id})) ids.push_back({id});
    }
    return ids;
  }

  void changeRobots() {
    m_robot.name = "custom";
    m_controller->edits()->setModel(edited(), m_robot);
  }

  /// What the first of them is; all get what is changed.
  void showRobots() {
    const std::vector<RobotId> ids = edited();
    const bool any = !ids.empty() && m_controller->edits()->physics() != "published";
    m_robots->setVisible(any);
    m_whose->setVisible(any);
    if (!any) return;
    const link::ScenarioRobot& first = *m_controller->edits()->robot(ids.front());
    const bool all = m_selection->ids().empty();
    m_whose->setText(all               ? QStringLiteral("All robots")
                     : ids.size() == 1 ? QStringLiteral("Robot %1").arg(robotName(first.identity))
                                       : QStringLiteral("%1 robots").arg(ids.size()));
    m_robot = first.model;
    const auto built = link::loadRobotModel(m_robot.name);
    const int found = built && *built == m_robot
                          ? m_kind->findData(QString::fromStdString(m_robot.name))
                          : m_kind->count() - 1;
    m_kind->setCurrentIndex(found);
    m_kick->setCurrentIndex(static_cast<int>(m_robot.kickLaw));
    showRows(m_robotRows, sim::robotModelParameters, m_robot);
  }

  void addPhysics(QWidget* form, QVBoxLayout* column) {
    column->addWidget(partTitle(QStringLiteral("Physics"), form));
    m_model = new QComboBox(form);
    m_model->setObjectName(QStringLiteral("physicsModel"));
    for (const sim::PhysicsModelInfo& model : sim::physicsModels()) {
      const QString name = QString::fromUtf8(model.name.data(), qsizetype(model.name.size()));
      m_model->addItem(name, name);
      m_model->setItemData(
          m_model->count() - 1,
          QString::fromUtf8(model.description.data(), qsizetype(model.description.size())),
          Qt::ToolTipRole);
    }
    connect(m_model, &QComboBox::activated, this,
            [this] { m_controller->edits()->setPhysics(m_model->currentData().toString()); });
    column->addWidget(m_model);
    column->addWidget(makeExplanation(
        QStringLiteral("The robots and the ball stop when you change the physics model."), form));
    m_exact = makeExplanation(
        QStringLiteral(
            "“published” matches the published simulator bit for bit. It has no adjustable "
            "constants and a single robot model; the IMU drifts but has no noise; vision misses "
            "nothing and has no delay. Speeds are per frame, so a tick rate other than 60 makes "
            "everything faster or slower. Choose “rigid-body” to change any of this."),
        form);
    column->addWidget(m_exact);
    m_body = new QWidget(form);
    auto* grid = new QGridLayout(m_body);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(scaled(this, 4));
    grid->setColumnStretch(1, 1);
    for (const auto& p : sim::rigidBodyParameters) {
      m_bodyRows.push_back(rowOf(grid, p, m_body, [this, &p](double stored) {
        m_constants.*p.member = stored;
        m_controller->edits()->setRigidBody(m_constants);
      }));
    }
    m_falls = new QCheckBox(QString::fromUtf8(sim::fallsSwitch.name), m_body);
    connect(m_falls, &QCheckBox::toggled, this, [this](bool on) {
      m_constants.falls = on;
      m_controller->edits()->setRigidBody(m_constants);
    });
    grid->addWidget(m_falls, grid->rowCount(), 0, 1, 3);
    column->addWidget(m_body);
  }

  /// Below the rows that the grid has. `edited` gets the value as it is in memory.
  template <class Values>
  ParameterRow* rowOf(QGridLayout* grid, const sim::Parameter<Values>& p, QWidget* parent,
                      std::function<void(double)> edited) {
    return new ParameterRow(
        grid, QString::fromUtf8(p.name), QString::fromUtf8(p.meaning), p.shown,
        [&p, edited = std::move(edited)](double shown) {
          edited(p.stored(shown / p.shown.factor));
        },
        parent);
  }

  template <class Values, std::size_t N>
  void showRows(const std::vector<ParameterRow*>& rows,
                const std::array<sim::Parameter<Values>, N>& parameters, const Values& values) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& p = parameters[i];
      rows[i]->show(p.written(values.*p.member) * p.shown.factor);
    }
  }

  void choosePreset() {
    const auto preset = link::noisePreset(m_preset->currentText().toStdString());
    if (preset) {
      m_noise = *preset;
      m_controller->edits()->setNoise(m_noise);
    }
    showNoise();
  }

  void showPreset() {
    int found = m_preset->count() - 1;
    for (int i = 0; i + 1 < m_preset->count(); ++i) {
      const auto preset = link::noisePreset(m_preset->itemText(i).toStdString());
      if (preset && *preset == m_noise) {
        found = i;
        break;
      }
    }
    m_preset->setCurrentIndex(found);
  }

  void showNoise() {
    showRows(m_noiseRows, sim::noiseParameters, m_noise);
    for (ParameterRow* row : m_noiseRows) row->setEnabled(!m_noise.ofModel);
    showPreset();
  }

  void adopt() {
    const sim::SimulationSettings& settings = m_controller->scenario().settings;
    m_noise = m_shown.noise = settings.noise;
    m_shown.rigidBody = settings.rigidBody;
    m_shown.physics = settings.physics;
    showNoise();
    showConstants(settings.rigidBody);
    showPhysics(m_controller->edits()->physics());
  }

  void showPhysics(const std::string& model) {
    m_model->setCurrentIndex(m_model->findData(QString::fromStdString(model)));
    m_exact->setVisible(model == "published");
    m_body->setVisible(model != "published");
    showRobots();
  }

  /// What the match is played with at the moment that is shown. It may have been changed elsewhere;
  /// our own changes arrive here a moment later.
  void follow() {
    const FramePtr frame = m_moment->frame();
    if (!frame || !m_moment->kind().canBeEdited) return;
    const link::FrameSettings& now = *frame->settings;
    if (now.noise != m_shown.noise) {
      m_noise = now.noise;
      showNoise();
    }
    if (now.rigidBody != m_shown.rigidBody) showConstants(now.rigidBody);
    if (now.physics != m_shown.physics) showPhysics(now.physics);
    m_shown = now;
  }

  void showConstants(const Body& constants) {
    m_constants = constants;
    showRows(m_bodyRows, sim::rigidBodyParameters, m_constants);
    const QSignalBlocker quiet(m_falls);
    m_falls->setChecked(m_constants.falls);
  }

  MatchController* m_controller;
  RobotSelection* m_selection;
  const ShownMoment* m_moment;
  std::unique_ptr<Beat::Part> m_follow;
  QLabel* m_whose = nullptr;
  QWidget* m_robots = nullptr;
  QComboBox* m_kind = nullptr;
  QComboBox* m_kick = nullptr;
  sim::RobotModel m_robot;
  Noise m_noise;
  link::FrameSettings m_shown;
  Body m_constants;
  QComboBox* m_preset = nullptr;
  QComboBox* m_model = nullptr;
  QLabel* m_exact = nullptr;
  QWidget* m_body = nullptr;
  QCheckBox* m_falls = nullptr;
  std::vector<ParameterRow*> m_noiseRows, m_robotRows, m_bodyRows;
};

}  // namespace

QWidget* makeNoiseDock(MatchController* controller, RobotSelection* selection,
                       const ShownMoment* shown, QWidget* parent) {
  return new NoiseDock(controller, selection, shown, parent);
}

}  // namespace pitchboard::ui
