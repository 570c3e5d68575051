// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "process_group.h"

namespace transillum::mpi {

/// Splits a pass into messages for the members of a group. Each gets the values of the whole pass,
/// the coverages of the patches it owns, and the exchanges that meet one of them.
/// Pass::run is not sent: it follows from the exchanges.
GroupMessages split(const Pass& pass, const PatchSums& group, PatchId patches);

/// The pass in a message of split(), for its receiver: Coverage lists begin with the first patch it
/// owns.
/// @param owned the patches of the receiver
Pass joined_pass(std::span<const std::byte> message, const PatchRange& owned);

/// Rough size of the messages of one pass to all members, bytes.
std::uint64_t expected_message_bytes(PatchId patches);

}  // namespace transillum::mpi
