NC0413 = coordinates written without the frame
    .label = { $target } has no code for this frame
    .account = frames into the coordinates
