#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/open_mouth.h"

namespace daumier::faces {

/// Teeth behind the lips, as far as these are apart, and a tongue: closed surfaces within the bag of the mouth. Nothing
/// where no place of the mouth is open by 0.05 of its width. `lips`: of the template.
void AddTeeth(const LipContours& lips, const geometry::Points& face, HeadSoup& soup);

}  // namespace daumier::faces
