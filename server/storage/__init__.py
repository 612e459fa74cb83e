"""What survives a power cut: jobs with their journal, vehicles, and where the plug is."""
