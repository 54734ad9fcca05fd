// A small reader of JSON for the tests: maps, lists, strings without escapes, numbers.
using System;
using System.Collections.Generic;
using System.Globalization;
using Map = System.Collections.Generic.Dictionary<string, object>;
using Items = System.Collections.Generic.List<object>;

static class Json
{
    public static object Parse(string text) { int at = 0; return Value(text, ref at); }

    static void Space(string t, ref int at) { while (at < t.Length && char.IsWhiteSpace(t[at])) ++at; }

    static string Text(string t, ref int at)
    {
        int stop = t.IndexOf('"', at + 1);
        string found = t.Substring(at + 1, stop - at - 1);
        at = stop + 1;
        return found;
    }

    static object Value(string t, ref int at)
    {
        Space(t, ref at);
        if (t[at] == '{' || t[at] == '[')
        {
            bool map = t[at] == '{';
            var fields = new Map();
            var items = new Items();
            ++at;
            Space(t, ref at);
            while (t[at] != '}' && t[at] != ']')
            {
                if (map) { string key = Text(t, ref at); Space(t, ref at); ++at; fields[key] = Value(t, ref at); }
                else items.Add(Value(t, ref at));
                Space(t, ref at);
                if (t[at] == ',') { ++at; Space(t, ref at); }
            }
            ++at;
            return map ? (object)fields : items;
        }
        if (t[at] == '"') return Text(t, ref at);
        if (t[at] == 'n') { at += 4; return null; }
        if (t[at] == 't') { at += 4; return true; }
        if (t[at] == 'f') { at += 5; return false; }
        int end = at;
        while (end < t.Length && "+-.0123456789eE".IndexOf(t[end]) >= 0) ++end;
        double number = double.Parse(t.Substring(at, end - at), CultureInfo.InvariantCulture);
        at = end;
        return number;
    }
}
