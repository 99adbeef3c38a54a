// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The name of an abstract Unix socket as a lock that cannot outlive its owner: the kernel frees it
// whatever happens. Names are shared by all users of the machine, so the user is part of them.
// Private to the room; any thread.

#include <string>

#include <base/descriptor.h>
#include <base/result.h>

namespace pitchboard::link {

struct NameLock {
  Descriptor socket;   ///< holds the name while it is open; empty: somebody else holds it
  std::string holder;  ///< "pitchboard, process 123", "this program"; empty: it is just changing
};

/// Takes "pitchboard-`name`" of this user. An error is a refusal of the system.
Result<NameLock> lockName(const std::string& name, const std::string& context);

}  // namespace pitchboard::link
