#pragma once

namespace hlc::dds {

/// Registers the type objects of all 28 lab types. The lab's processes announce theirs, and Fast
/// DDS 2.9 crashes on the announcement of a type with a sequence of structs that this process has
/// not registered, whether or not it uses the topic (lab wire contract, 0.1). To be called before
/// the first participant.
void register_lab_types();

}  // namespace hlc::dds
