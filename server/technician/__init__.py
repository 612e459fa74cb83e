"""What only the technician's page asks for: made once, at work only while somebody looks."""
