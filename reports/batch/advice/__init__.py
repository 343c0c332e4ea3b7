"""What a user needs: for each case and engine the settings with which it keeps what is asked."""
