#pragma once

namespace osteon {

struct PanelContext;

/// Of an exercise: how far the knee is bent; with the graft in it how the tail is pulled, and what
/// the bending showed; and how it is examined.
void draw_exercise_knee(const PanelContext& c);

}  // namespace osteon
