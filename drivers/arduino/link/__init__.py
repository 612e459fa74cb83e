"""The link to the motion board as pure logic: frames, sequence, clock. Nothing here does I/O."""
