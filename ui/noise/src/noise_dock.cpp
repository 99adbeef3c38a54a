// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/noise/noise_dock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QScrollArea>
#include <QVBoxLayout>
#include <numbers>

#include <ui/base/parameter_rows.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
using Noise = sim::NoiseParameters;
using Body = sim::RigidBodySettings;

constexpr Parameter<Noise> noiseParameters[] = {
    {"Forward", &Noise::forward, 100, 0, 2, 3, " cm/frame", "σ per 1/60 s of walking"},
    {"Sideways", &Noise::sideways, 100, 0, 2, 3, " cm/frame", "σ per 1/60 s of walking"},
    {"Rotation", &Noise::rotation, degrees, 0, 2, 3, " °/frame", "σ per 1/60 s of walking"},
    {"Kick speed", &Noise::kickSpeed, 1, 0, 3, 2, " m/s", "σ of the ball's speed"},
    {"Kick angle", &Noise::kickAngle, degrees, 0, 45, 1, " °", "σ of the ball's direction"},
    {"Ball distance", &Noise::visionDistance, 100, 0, 50, 1, " %", "σ, share of the distance"},
    {"Ball bearing", &Noise::visionBearing, degrees, 0, 20, 1, " °", "σ"},
    {"Robot distance", &Noise::robotDistance, 100, 0, 100, 0, " cm", "σ, other robots"},
    {"Robot bearing", &Noise::robotBearing, degrees, 0, 20, 1, " °", "σ, other robots"},
    {"Landmark bearing", &Noise::landmarkBearing, degrees, 0, 30, 1, " °", "σ, field corners"},
    {"Landmark seen", &Noise::landmarkProbability, 100, 0, 100, 0, " %",
     "Probability that a landmark in view is seen in a frame"},
    {"Missed", &Noise::missedDetection, 100, 0, 100, 0, " %",
     "Probability that a ball or robot in view is not seen"},
    {"Vision delay", &Noise::visionDelay, 1000, 0, 1000, 0, " ms",
     "From the moment seen to the moment on the blackboard"},
    {"IMU yaw", &Noise::imuWhite, degrees, 0, 10, 2, " °", "σ, anew each tick"},
    {"IMU drift", &Noise::imuDrift, degrees, 0, 1, 3, " °/frame", "σ per 1/60 s, accumulating"},
};

constexpr Parameter<Body> bodyParameters[] = {
    {"Acceleration", &Body::maxAcceleration, 1, 0.05, 10, 2, " m/s²", "Largest of the gait"},
    {"Yaw acceleration", &Body::maxYawAcceleration, degrees, 10, 2000, 0, " °/s²",
     "Largest of the gait"},
    {"Robot mass", &Body::robotMass, 1, 0.1, 50, 1, " kg", ""},
    {"Ball mass", &Body::ballMass, 1, 0.01, 2, 2, " kg", ""},
    {"Ball keeps", &Body::ballFriction, 100, 0, 100, 1, " %", "Share of its speed kept in 1/60 s"},
    {"Bounce off posts", &Body::postRestitution, 100, 0, 100, 0, " %", "Also off walls and nets"},
    {"Bounce off robots", &Body::robotRestitution, 100, 0, 100, 0, " %", ""},
    {"Fall impulse", &Body::fallImpulse, 1, 0.05, 20, 2, " N·s", "Throws a robot down"},
    {"Time to get up", &Body::getUpTime, 1, 0.1, 30, 1, " s", ""},
    {"Head speed", &Body::headSpeed, degrees, 1, 720, 0, " °/s", ""},
    {"Field of view", &Body::fieldOfView, degrees, 1, 360, 0, " °", "In all"},
    {"Head pan limit", &Body::panLimit, degrees, 0, 180, 0, " °", "To either side"},
    {"Vision range", &Body::visionRange, 1, 0.1, 20, 1, " m", ""},
};

QLabel* heading(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(themeFont(TypeRole::Body, true));
  label->setContentsMargins(0, scaled(parent, 8), 0, 0);
  return label;
}

QLabel* remark(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(themeFont(TypeRole::Secondary));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

class NoiseDock : public QScrollArea {
 public:
  NoiseDock(MatchController* controller, QWidget* parent)
      : QScrollArea(parent), m_controller(controller) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* form = new QWidget(this);
    auto* column = new QVBoxLayout(form);
    const int edge = scaled(this, 8);
    column->setContentsMargins(edge, 0, edge, edge);
    column->setSpacing(scaled(this, 6));
    addNoise(form, column);
    addPhysics(form, column);
    column->addStretch(1);
    setWidget(form);
    setMinimumWidth(form->minimumSizeHint().width() + scaled(this, 14));
    for (auto* control : form->findChildren<QWidget*>()) {
      if (control->focusPolicy() != Qt::WheelFocus && !qobject_cast<QSlider*>(control)) continue;
      if (control->focusPolicy() == Qt::WheelFocus) control->setFocusPolicy(Qt::StrongFocus);
      control->installEventFilter(this);
    }
    connect(m_controller, &MatchController::scenarioChanged, this, [this] { adopt(); });
    connect(m_controller, &MatchController::frameReceived, this,
            [this](const FramePtr& frame) { follow(*frame); });
    adopt();
  }

 protected:
  // Scrolling the panel must not change what happens to lie under the cursor.
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::Wheel || static_cast<QWidget*>(watched)->hasFocus()) {
      return QScrollArea::eventFilter(watched, event);
    }
    event->ignore();
    return true;
  }

 private:
  void addNoise(QWidget* form, QVBoxLayout* column) {
    column->addWidget(heading(tr("Noise"), form));
    m_preset = new QComboBox(form);
    m_preset->setObjectName(QStringLiteral("noisePreset"));
    for (const std::string& name : link::noisePresets()) {
      m_preset->addItem(QString::fromStdString(name));
    }
    m_preset->addItem(tr("custom"));
    connect(m_preset, &QComboBox::activated, this, [this] { choosePreset(); });
    column->addWidget(m_preset);
    auto* grid = new QGridLayout;
    grid->setVerticalSpacing(scaled(this, 4));
    grid->setColumnStretch(1, 1);
    int row = 0;
    for (const auto& p : noiseParameters) {
      m_noiseRows.push_back(new ParameterRow(
          grid, row++, tr(p.name), QString::fromUtf8(p.unit), tr(p.tip), p.minimum, p.maximum,
          p.decimals,
          [this, &p](double shown) {
            m_noise.*p.member = shown / p.factor;
            showPreset();
            m_controller->edits()->setNoise(m_noise);
          },
          form));
    }
    column->addLayout(grid);
  }

  void addPhysics(QWidget* form, QVBoxLayout* column) {
    column->addWidget(heading(tr("Physics"), form));
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
    column->addWidget(remark(tr("Changing the model goes on from this moment with everything at "
                                "rest and forgets what can be undone."),
                             form));
    m_exact = remark(tr("“published” follows the published simulator to the last bit: it has no "
                        "constants to change. Choose “rigid-body” to change them."),
                     form);
    column->addWidget(m_exact);
    m_body = new QWidget(form);
    auto* grid = new QGridLayout(m_body);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(scaled(this, 4));
    grid->setColumnStretch(1, 1);
    int row = 0;
    for (const auto& p : bodyParameters) {
      m_bodyRows.push_back(new ParameterRow(
          grid, row++, tr(p.name), QString::fromUtf8(p.unit), tr(p.tip), p.minimum, p.maximum,
          p.decimals,
          [this, &p](double shown) {
            m_constants.*p.member = shown / p.factor;
            m_controller->edits()->setRigidBody(m_constants);
          },
          m_body));
    }
    m_falls = new QCheckBox(tr("Robots fall when hit hard"), m_body);
    connect(m_falls, &QCheckBox::toggled, this, [this](bool on) {
      m_constants.falls = on;
      m_controller->edits()->setRigidBody(m_constants);
    });
    grid->addWidget(m_falls, row, 0, 1, 3);
    column->addWidget(m_body);
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
    for (std::size_t i = 0; i < m_noiseRows.size(); ++i) {
      const auto& p = noiseParameters[i];
      m_noiseRows[i]->show(m_noise.*p.member * p.factor);
    }
    showPreset();
  }

  void adopt() {
    const sim::SimulationSettings& settings = m_controller->scenario().settings;
    m_noise = m_shown = settings.noise;
    m_constants = settings.rigidBody;
    showNoise();
    for (std::size_t i = 0; i < m_bodyRows.size(); ++i) {
      const auto& p = bodyParameters[i];
      m_bodyRows[i]->show(m_constants.*p.member * p.factor);
    }
    const QSignalBlocker quiet(m_falls);
    m_falls->setChecked(m_constants.falls);
    const QString model = QString::fromStdString(settings.physics);
    m_model->setCurrentIndex(m_model->findData(model));
    m_exact->setVisible(settings.physics == "published");
    m_body->setVisible(settings.physics != "published");
  }

  // The noise may have been changed elsewhere; our own changes arrive here a moment later.
  void follow(const link::MatchFrame& frame) {
    if (frame.noise == m_shown) return;
    m_shown = m_noise = frame.noise;
    showNoise();
  }

  MatchController* m_controller;
  Noise m_noise, m_shown;
  Body m_constants;
  QComboBox* m_preset = nullptr;
  QComboBox* m_model = nullptr;
  QLabel* m_exact = nullptr;
  QWidget* m_body = nullptr;
  QCheckBox* m_falls = nullptr;
  std::vector<ParameterRow*> m_noiseRows, m_bodyRows;
};

}  // namespace

QWidget* makeNoiseDock(MatchController* controller, QWidget* parent) {
  return new NoiseDock(controller, parent);
}

}  // namespace pitchboard::ui
