// Samples of a pixel, as masks name them.

// The first sample of the mask. Where all pixels of a group go through a loop together (llvmpipe, Mesa 22.3), a sample is looked up for
// those that are done with theirs, too: their mask is 0, findLSB(0) is -1, and the look-up was seen to crash.
int firstSample(uint mask) { return max(findLSB(mask), 0); }
