// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/physics/physics_model.h>

#include <array>

namespace pitchboard::sim {
namespace {

struct Registration {
  PhysicsModelInfo info;
  std::unique_ptr<PhysicsModel> (*make)();
};

constexpr std::array<Registration, 2> registrations{{
    {{"rigid-body", "Rigid circles that collide, in metres and seconds."}, &makeRigidBodyModel},
    {{"published", "The published simulator, bit for bit."}, &makePublishedModel},
}};

constexpr auto infos = [] {
  std::array<PhysicsModelInfo, registrations.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = registrations[i].info;
  return all;
}();

}  // namespace

std::span<const PhysicsModelInfo> physicsModels() {
  return infos;
}

std::unique_ptr<PhysicsModel> makePhysicsModel(std::string_view name) {
  for (const Registration& registration : registrations) {
    if (registration.info.name == name) return registration.make();
  }
  return nullptr;
}

}  // namespace pitchboard::sim
