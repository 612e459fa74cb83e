"""What host and motion board say to each other; see README.md in this directory."""
