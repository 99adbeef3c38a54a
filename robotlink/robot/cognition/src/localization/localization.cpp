// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_makers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <base/angles.h>
#include <base/try.h>
#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/published_frame.h>
#include "localization/monte_carlo_localization.h"

namespace pitchboard::link {
namespace {

constexpr float unseen = -999.0F;
constexpr double cycle = 0.05;         // s
constexpr double maxGap = 1.0;         // s; a process that was stopped does not walk on
constexpr double minSigma = 0.1;       // m; the blackboard has whole centimetres and degrees,
constexpr double yawSigma = 0.035;     // rad (2 deg); and nothing of how sure the heading is
constexpr double sureEnough_cm = 1.0;  // published: landmarks are asked for above this sigma

// Reads CONTROL_ACTION, the four landmarks and IMU_EULER_Z; writes LOCALIZATION_X, _Y, _THETA
// (whole cm and degrees, origin top left, y down), the belief (sigma in cm) in
// LOCALIZATION_RBT01_X, what vision is to look for in DECISION_LOCALIZATION (1 landmarks, 0 ball)
// and LOCALIZATION_WORKING.
class Localization final : public CognitiveProcess {
 public:
  Localization(MonteCarloLocalization filter, const sim::FieldSpec& field,
               const sim::RobotModel& body)
      : m_filter(std::move(filter)), m_field(field), m_body(body) {}

  void step(Blackboard& board, const Clock& clock) override {
    LocalizationInput input;
    input.seconds = m_last ? std::clamp(clock.seconds - *m_last, 0.0, maxGap) : 0.0;
    m_last = clock.seconds;
    const sim::GaitSpeed speed = sim::gaitSpeed(m_body, board.read(m_variables.controlAction),
                                                board.read(m_variables.decisionActionB));
    input.forward = speed.forward * input.seconds;
    input.left = speed.left * input.seconds;
    input.turn = speed.turn * input.seconds;
    input.inMotion = speed.inMotion;
    takeLandmarks(board, input);
    input.imuYaw = static_cast<double>(board.read(m_variables.imuEulerZ));
    m_filter.update(input);
    publish(board);
    m_first = false;
  }

  double period() const override { return cycle; }

  void sendDebugData(CognitionDebug& cognitionDebug) const override {
    auto cloud = std::make_shared<ParticleCloud>();
    const int count = m_filter.size();
    const int shown = std::min(count, static_cast<int>(ParticleCloud::most));
    cloud->particles.reserve(static_cast<std::size_t>(shown));
    double sum = 0.0;
    for (int i = 0; i < shown; ++i) {
      // Evenly over the whole set: neighbours in it are copies of one another.
      const auto index = static_cast<int>(static_cast<long long>(i) * count / shown);
      const Pose pose = m_filter.particle(index);
      cloud->particles.push_back({pose.position, pose.yaw, m_filter.weight(index)});
      sum += cloud->particles.back().weight;
    }
    for (Particle& particle : cloud->particles)
      particle.weight = sum > 0.0 ? particle.weight / sum : 0.0;
    const PoseBelief& belief = m_filter.belief();
    cloud->count = count;
    cloud->pose = belief.pose;
    cloud->sigma = belief.sigma;
    cognitionDebug.cloud = std::move(cloud);
  }

  void resume(const Blackboard& board) override {
    const auto sigma_cm = static_cast<double>(board.read(m_variables.localizationBelief));
    // Fresh memory holds zeros, and no filter is that sure.
    if (!std::isfinite(sigma_cm) || sigma_cm <= 0.0) return;
    const Pose pose = sim::published_frame::studioFromLocalization(
        m_field, {static_cast<double>(board.read(m_variables.localizationX)),
                  static_cast<double>(board.read(m_variables.localizationY)),
                  static_cast<double>(board.read(m_variables.localizationTheta))});
    m_filter.reset(pose, std::max(minSigma, sim::published_frame::metresFromCm(sigma_cm)),
                   yawSigma);
    m_last.reset();
    m_first = false;
  }

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    auto memory = std::make_unique<Localization>(m_filter.compact(), m_field, m_body);
    memory->m_last = m_last;
    memory->m_first = m_first;
    return memory;
  }

  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const Localization*>(&memory);
    if (!other) return false;
    m_filter = other->m_filter;
    m_last = other->m_last;
    m_first = other->m_first;
    return true;
  }

  std::size_t memoryBytes() const override { return sizeof *this + m_filter.compactBytes(); }

 private:
  void takeLandmarks(Blackboard& board, LocalizationInput& input) {
    for (std::size_t i = 0; i < input.corners.size(); ++i) {
      const float degrees = board.read(m_variables.landmarkDeg[i]);
      board.write(m_variables.landmarkDeg[i], unseen);
      // What stands there before the first cycle may be the zero of fresh memory.
      if (!m_first && std::isfinite(degrees) && std::abs(degrees) <= 360.0F) {
        input.corners[i] = radiansFromDegrees(static_cast<double>(degrees));
      }
    }
  }

  void publish(Blackboard& board) {
    const PoseBelief& belief = m_filter.belief();
    const auto pose = sim::published_frame::localizationFromStudio(m_field, belief.pose);
    const double sigma_cm = sim::published_frame::cmFromMetres(belief.sigma);
    board.write(m_variables.localizationX, static_cast<int>(std::lround(pose.x)));
    board.write(m_variables.localizationY, static_cast<int>(std::lround(pose.y)));
    board.write(m_variables.localizationTheta, static_cast<int>(std::lround(pose.degrees)));
    board.write(m_variables.localizationBelief, static_cast<float>(sigma_cm));
    board.write(m_variables.decisionLocalization, sigma_cm > sureEnough_cm ? 1 : 0);
    board.write(m_variables.localizationWorking, 1);
  }

  MonteCarloLocalization m_filter;
  sim::FieldSpec m_field;
  sim::RobotModel m_body;
  RobotVariables m_variables;
  std::optional<double> m_last = 0.0;  // nothing: it came into a match that goes on
  bool m_first = true;
};

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makeLocalization(const ProcessOptions& options) {
  LocalizationParameters parameters;
  if (options.publishedLocalization) {
    parameters = LocalizationParameters::published();
  } else {
    parameters.maxParticles = options.particles;
    parameters.minParticles = std::min(parameters.minParticles, options.particles);
  }
  const ImuZero zero = !options.facesLeft   ? ImuZero::Unknown
                       : *options.facesLeft ? ImuZero::Left
                                            : ImuZero::Right;
  auto filter = TRY(MonteCarloLocalization::create(options.field, parameters, zero, options.seed,
                                                   options.robot.value));
  return std::make_unique<Localization>(std::move(filter), options.field, options.model);
}

}  // namespace pitchboard::link
