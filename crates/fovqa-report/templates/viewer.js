// The viewer of frames.
